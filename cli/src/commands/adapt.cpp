#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include <octetra/distributed/profile.hpp>

#include "adapt/adapt_by_reference.hpp"
#include "adapt/adaptation.hpp"
#include "commands/commands.hpp"
#include "commands/engine_option.hpp"
#include "commands/number_options.hpp"

namespace octetra::cli {
namespace {

struct AdaptOptions {
    std::string script;
    std::string engine = "distributed";
    AdaptationOptions adaptation;
};

}  // namespace

void add_adapt(CLI::App& program, const distributed::Communicator& world) {
    auto options = std::make_shared<AdaptOptions>();
    CLI::App* command =
        program.add_subcommand("adapt", "Refine and coarsen a mesh by the steps of a script");
    add_input_options(*command, options->adaptation.input);
    add_fields_option(*command, options->adaptation.input);
    command
        ->add_option("--script", options->script,
                     "the steps, one per line, in order of execution; - for standard input")
        ->type_name("FILE")
        ->check(file_name_validator())
        ->required();
    add_output_option(*command, options->adaptation.output);
    command
        ->add_option(
            "--series", options->adaptation.series,
            "also write MESH and the result of each step to one file for ParaView: .vtkhdf")
        ->type_name("FILE")
        ->check(file_name_validator());
    add_number(*command, "--max-cells", options->adaptation.max_cells, whole_numbers_from(1),
               "fail before a step that would exceed N cells")
        ->type_name("N");
    add_engine_options(*command, options->engine, options->adaptation.parallel);
    add_profile_options(*command, options->adaptation.profile);
    command->add_flag(
        "--verify", options->adaptation.verify,
        "verify the result as a refinement of MESH, and write OUT only if it is valid");
    command->add_flag("--quiet", options->adaptation.quiet, "print only notes and errors");
    command->footer(
        "Steps, with the options of the subcommands of these names; # begins a comment:\n"
        "  refine CRITERION... [--levels L] [--target-cells N] [--scheme 8t|4t|2t] [--closure C]\n"
        "  coarsen CRITERION... [--outside] [--levels L]   undo refinement, by one step per "
        "level,\n"
        "                                                  in these cells, or outside them\n"
        "  fit --size SIZE [--gradation R] [--levels L]    refine and coarsen to a target size; "
        "also\n"
        "                                                  --scheme and --closure\n"
        "  rebalance                                       under mpirun: balance the cells of "
        "ranks;\n"
        "                                                  changes no file\n"
        "  save FILE.octetra                               write the current mesh with its "
        "history\n"
        "  write FILE                                      write the current mesh in any format\n"
        "--cells uses the numbers of a file written just before the step, from 0 or 1 as in MESH.\n"
        "Names with blanks are quoted. All lines are checked before the first step is run.\n"
        "Fields of --fields or a .octetra are transferred: midpoints get means, pieces copies,\n"
        "merged cells means; integers that have no mean are dropped, with a note.\n"
        "Exit status: 0 done; 1 --verify finds the result not valid, and OUT is not written;\n"
        "2 bad usage or bad input; 3 the system failed: memory, disk; 128 + its number: a signal\n"
        "ended a rank, for example 137 if it was killed.\n"
        "Example:\n"
        "  octetra generate kuhn 8 -o cube.mesh\n"
        "  echo 'refine --sphere 0,0,0,0.5 --levels 2' > steps.txt\n"
        "  echo 'coarsen --outside --sphere 0,0,0,0.3' >> steps.txt\n"
        "  octetra adapt cube.mesh --script steps.txt -o fine.vtu\n"
        "  mpirun -n 4 octetra adapt cube.mesh --script steps.txt -o fine.vtu");
    command->callback([options, world] {
        const distributed::Communicator all = measured(world, options->adaptation.profile);
        const Script script =
            distributed::in_phase(all, "read", [&] { return read_script(options->script, all); });
        if (parse_engine(options->engine, options->adaptation.parallel) == Engine::distributed) {
            return adapt(options->adaptation, script, all);
        }
        all.on_first([&] { adapt_by_reference(options->adaptation, script); });
    });
}

}  // namespace octetra::cli
