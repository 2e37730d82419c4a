#pragma once

#include <string>

#include <octetra/core/expression.hpp>

#include "commands/refinement_options.hpp"

namespace octetra::cli {

/// Declares the options of a step that fits a mesh: --size, --gradation, --levels, --scheme and
/// --closure. The options refer to no criterion but --size.
void add_fitting_options(CLI::App& subcommand, RefinementOptions& options,
                         const std::string& group);

/// Returns the expression of the target size. Throws InputError if it is missing or invalid.
[[nodiscard]] Expression parse_target_size(const RefinementOptions& options);

}  // namespace octetra::cli
