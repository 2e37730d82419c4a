#include "commands/refinement_options.hpp"

#include <algorithm>
#include <array>

#include <CLI/CLI.hpp>

#include "choice.hpp"
#include "commands/number_options.hpp"

namespace octetra::cli {

void add_refinement_options(CLI::App& subcommand, RefinementOptions& options,
                            const std::string& group) {
    add_selection_options(subcommand, options.selection, group);
    add_number<std::uint64_t>(
        subcommand, "--levels", options.levels, {0, 50, "0 to 50"},
        "how often to mark and bisect; what is marked is judged afresh each time [1]")
        ->type_name("L");
    subcommand
        .add_option("--scheme", options.scheme,
                    "a marked cell marks all its edges, its faces' longest, or its longest [8t]")
        ->type_name("8t|4t|2t");
}

bool was_given(const CLI::App& subcommand, std::string_view name) {
    // Not by App::count(), which copies names where nothing may be thrown, not even std::bad_alloc.
    const auto options = subcommand.get_options();
    return std::ranges::any_of(options, [&](const CLI::Option* option) {
        return option->count() > 0 && std::ranges::count(option->get_lnames(), name) > 0;
    });
}

bool says_how_refined(const CLI::App& subcommand) {
    return was_given(subcommand, "levels") || was_given(subcommand, "scheme") ||
           was_given(subcommand, "seed");
}

Scheme parse_scheme(const RefinementOptions& options) {
    constexpr std::array<Word<Scheme>, 3> schemes{
        {{"8t", Scheme::eight}, {"4t", Scheme::four}, {"2t", Scheme::two}}};
    return parse_choice("--scheme", options.scheme, schemes);
}

}  // namespace octetra::cli
