#include <memory>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>
#include <octetra/core/files/checkpoint.hpp>

#include "adapt/adaptation.hpp"
#include "commands/coarsening_options.hpp"
#include "commands/commands.hpp"

namespace octetra::cli {
namespace {

struct CoarsenOptions {
    CoarseningOptions coarsening;
    AdaptationOptions adaptation;
};

void coarsen(const CoarsenOptions& options, const distributed::Communicator& world) {
    const std::string& input = options.adaptation.input.path;
    if (!is_checkpoint(input)) {
        throw InputError(
            fmt::format("{} has no refinement history: coarsening requires a .octetra file, as "
                        "written by octetra refine or adapt with -o FILE.octetra",
                        input));
    }
    const Selection selection = parse_coarsening(options.coarsening);
    if (options.adaptation.verify) check_verifiable(selection);
    AdaptationOptions adaptation = options.adaptation;
    adaptation.claim = Claim::coarsens_mesh;
    const Script one_step{{}, false, {{0, "coarsen", CoarsenStep{options.coarsening, selection}}}};
    adapt(adaptation, one_step, measured(world, options.adaptation.profile));
}

}  // namespace

void add_coarsen(CLI::App& program, const distributed::Communicator& world) {
    auto options = std::make_shared<CoarsenOptions>();
    CLI::App* command =
        program.add_subcommand("coarsen", "Undo refinement, by one step, in selected cells");
    command
        ->add_option("MESH", options->adaptation.input.path,
                     "the mesh with its history: .octetra, as written by refine and adapt")
        ->type_name("")
        ->check(file_name_validator())
        ->required();
    add_fields_option(*command, options->adaptation.input);
    add_output_option(*command, options->adaptation.output);
    add_coarsening_options(*command, options->coarsening,
                           "Cells to coarsen (criteria are combined; at least one is required)");
    add_partition_option(*command, options->adaptation.parallel);
    add_profile_options(*command, options->adaptation.profile);
    command->add_flag(
        "--verify", options->adaptation.verify,
        "verify the result (as octetra verify --coarsened-from); write it only if it is valid");
    command->add_flag("--quiet", options->adaptation.quiet, "print only notes and errors");
    command->footer(
        "Fields of MESH are transferred: merged cells get the mean of their values; integers that\n"
        "differ are dropped, with a note.\n"
        "Example:\n"
        "  octetra generate kuhn 8 -o cube.mesh\n"
        "  octetra refine cube.mesh --sphere 0,0,0,0.5 --levels 2 -o fine.octetra\n"
        "  octetra coarsen fine.octetra --outside --sphere 0,0,0,0.3 -o coarser.octetra\n"
        "  mpirun -n 4 octetra coarsen coarser.octetra --all --levels 9 -o cube.vtu");
    command->callback([options, command, world] {
        group_criteria(*command, options->coarsening.selection);
        coarsen(*options, world);
    });
}

}  // namespace octetra::cli
