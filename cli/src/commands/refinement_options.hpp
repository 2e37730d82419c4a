#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <octetra/core/closure.hpp>
#include <octetra/core/selection.hpp>

#include "commands/selection_options.hpp"

namespace octetra::cli {

/// The options of a subcommand for refinement, as given.
struct RefinementOptions {
    SelectionOptions selection;
    std::string scheme = "8t";
    std::string closure = "longest-edge";
    int levels = 1;
    std::optional<std::uint64_t> target_cells;
};

/// Declares the selection under the heading `group`, --levels and --scheme.
void add_refinement_options(CLI::App& subcommand, RefinementOptions& options,
                            const std::string& group);

/// Declares --scheme.
CLI::Option* add_scheme_option(CLI::App& subcommand, RefinementOptions& options);

/// Declares --closure, for subcommands that refine or verify a refinement.
void add_closure_option(
    CLI::App& subcommand, RefinementOptions& options,
    const std::string& description =
        "regular: bounds the angles of all refinements that continue from a checkpoint with\nthe "
        "same option [longest-edge]");

/// Declares --target-cells, for subcommands that refine.
void add_target_option(CLI::App& subcommand, RefinementOptions& options);

/// Sets the number of levels that --target-cells implies, unless it was given.
void complete_levels(const CLI::App& subcommand, RefinementOptions& options);

/// Returns whether the option with this name, without dashes, was given.
[[nodiscard]] bool was_given(const CLI::App& subcommand, std::string_view name);

/// Returns whether --levels, --scheme or --seed was given, even with the default value. They have
/// no meaning without a criterion.
[[nodiscard]] bool has_refinement_options(const CLI::App& subcommand);

/// Throws InputError for an unknown scheme.
[[nodiscard]] Scheme parse_scheme(const RefinementOptions& options);

/// Throws InputError for an unknown closure, or one that the scheme excludes.
[[nodiscard]] Closure parse_closure(const RefinementOptions& options);

}  // namespace octetra::cli
