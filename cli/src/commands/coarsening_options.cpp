#include "commands/coarsening_options.hpp"

#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>

#include "commands/number_options.hpp"

namespace octetra::cli {

void add_coarsening_options(CLI::App& subcommand, CoarseningOptions& options,
                            const std::string& group) {
    add_selection_options(subcommand, options.selection, group);
    subcommand
        .add_flag("--outside", options.outside,
                  "select the cells that no criterion selects instead")
        ->group(group);
    add_number<std::uint64_t>(
        subcommand, "--levels", options.levels, {0, 50, "0 to 50"},
        "number of levels; criteria are evaluated anew on each coarser mesh [1]")
        ->type_name("L");
}

Selection parse_coarsening(const CoarseningOptions& options) {
    Selection selection = parse_selection(options.selection, "which cells to coarsen");
    if (!options.selection.cells_file.empty() && options.levels > 1) {
        throw InputError(
            "--cells refers to the cells of one mesh, but --levels also coarsens later ones; give "
            "only one of the two");
    }
    return selection;
}

}  // namespace octetra::cli
