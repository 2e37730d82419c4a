#include "commands/refinement_options.hpp"

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

bool says_how_refined(const CLI::App& subcommand) {
    return subcommand.count("--levels") + subcommand.count("--scheme") +
               subcommand.count("--seed") >
           0;
}

Scheme parse_scheme(const RefinementOptions& options) {
    constexpr std::array<Word<Scheme>, 3> schemes{
        {{"8t", Scheme::eight}, {"4t", Scheme::four}, {"2t", Scheme::two}}};
    return parse_choice("--scheme", options.scheme, schemes);
}

}  // namespace octetra::cli
