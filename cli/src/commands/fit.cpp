#include <memory>

#include <CLI/CLI.hpp>

#include "adapt/adaptation.hpp"
#include "commands/commands.hpp"
#include "commands/fit_options.hpp"
#include "commands/number_options.hpp"
#include "commands/refinement_options.hpp"

namespace octetra::cli {
namespace {

struct FitCommandOptions {
    RefinementOptions fitting;
    AdaptationOptions adaptation;
};

void fit(const FitCommandOptions& options, const distributed::Communicator& world) {
    const RefinementOptions& fitting = options.fitting;
    const FitStep step{fitting, parse_target_size(fitting), parse_scheme(fitting),
                       parse_closure(fitting)};
    const Script one_step{{}, false, {{0, "fit", step}}};
    adapt(options.adaptation, one_step, measured(world, options.adaptation.profile));
}

}  // namespace

void add_fit(CLI::App& program, const distributed::Communicator& world) {
    auto options = std::make_shared<FitCommandOptions>();
    CLI::App* command = program.add_subcommand(
        "fit", "Refine and coarsen a mesh until its cells have a target size");
    AdaptationOptions& adaptation = options->adaptation;
    add_input_options(*command, adaptation.input);
    add_fields_option(*command, adaptation.input);
    add_output_option(*command, adaptation.output);
    add_fitting_options(*command, options->fitting, "Target size");
    add_number(*command, "--max-cells", adaptation.max_cells, whole_numbers_from(1),
               "fail, without writing, before a level that would exceed N cells")
        ->type_name("N");
    add_parallel_options(*command, adaptation.parallel);
    add_profile_options(*command, adaptation.profile);
    command->add_flag("--verify", adaptation.verify,
                      "verify the result as a refinement of MESH, or of the input of its history; "
                      "write\nit only if it is valid");
    command->add_flag("--quiet", adaptation.quiet, "print only notes and errors");
    command->footer(
        "Cells with an edge longer than the size are refined. Cells are merged if their longest\n"
        "edge is at most half the size; that requires the history of a .octetra file. So the\n"
        "longest edge of a cell is at most the size, and more than half of it where the input and\n"
        "the neighbours allow.\n"
        "Exit status: as for octetra refine.\n"
        "Example:\n"
        "  octetra generate kuhn 8 -o cube.mesh\n"
        "  octetra fit cube.mesh --size \"0.05 + hypot(x, hypot(y, z)) / 3\" -o fitted.octetra\n"
        "  octetra fit fitted.octetra --size \"0.05 + abs(x - 0.5) / 3\" -o moved.octetra\n"
        "  mpirun -n 4 octetra fit moved.octetra --size 0.1 -o even.vtu");
    command->callback([options, world] { fit(*options, world); });
}

}  // namespace octetra::cli
