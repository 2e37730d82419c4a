#pragma once

#include <string>
#include <string_view>

#include <octetra/core/selection.hpp>

#include "commands/selection_options.hpp"

namespace octetra::cli {

/// The options of a subcommand that say which refinement is meant, as they were typed.
struct RefinementOptions {
    SelectionOptions selection;
    std::string scheme = "8t";
    int levels = 1;
};

/// Declares the selection under the headline `group`, --levels and --scheme.
void add_refinement_options(CLI::App& subcommand, RefinementOptions& options,
                            const std::string& group);

/// Was the option with this name, without dashes, typed?
[[nodiscard]] bool was_given(const CLI::App& subcommand, std::string_view name);

/// Was --levels, --scheme or --seed typed, even with the default value? Without a
/// criterion they mean nothing.
[[nodiscard]] bool says_how_refined(const CLI::App& subcommand);

/// Throws InputError for a word that is no scheme.
[[nodiscard]] Scheme parse_scheme(const RefinementOptions& options);

}  // namespace octetra::cli
