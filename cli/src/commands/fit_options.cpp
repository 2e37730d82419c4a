#include "commands/fit_options.hpp"

#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>

#include "commands/number_options.hpp"
#include "commands/size_option.hpp"

namespace octetra::cli {

void add_fitting_options(CLI::App& subcommand, RefinementOptions& options,
                         const std::string& group) {
    options.levels = 50;
    add_size_option(subcommand, options.selection, group,
                    "the length that the longest edge of a cell is to have");
    add_number<std::uint64_t>(subcommand, "--levels", options.levels, {0, 50, "0 to 50"},
                              "the most levels of refinement in a sequence, and of coarsening [50]")
        ->type_name("L")
        ->group(group);
    add_scheme_option(subcommand, options)->group(group);
    add_closure_option(subcommand, options);
}

Expression parse_target_size(const RefinementOptions& options) {
    const std::vector<std::string>& sizes = options.selection.sizes;
    if (sizes.size() != 1) {
        throw InputError(sizes.empty() ? "specify the target size of cells: --size SIZE"
                                       : "--size can be given only once here");
    }
    return Expression(target_size(sizes.front(), options.selection.gradation));
}

}  // namespace octetra::cli
