#pragma once

#include <string>

#include <octetra/core/selection.hpp>

#include "commands/selection_options.hpp"

namespace octetra::cli {

/// The options of a subcommand or step for coarsening, as given.
struct CoarseningOptions {
    SelectionOptions selection;
    bool outside = false;
    int levels = 1;
};

/// Declares the selection under the heading `group`, --outside and --levels.
void add_coarsening_options(CLI::App& subcommand, CoarseningOptions& options,
                            const std::string& group);

/// Parses the parts that do not need the mesh. Throws InputError.
[[nodiscard]] Selection parse_coarsening(const CoarseningOptions& options);

}  // namespace octetra::cli
