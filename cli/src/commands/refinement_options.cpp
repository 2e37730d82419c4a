#include "commands/refinement_options.hpp"

#include <algorithm>
#include <array>

#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>

#include "choice.hpp"
#include "commands/number_options.hpp"

namespace octetra::cli {

void add_refinement_options(CLI::App& subcommand, RefinementOptions& options,
                            const std::string& group) {
    add_selection_options(subcommand, options.selection, group);
    add_number<std::uint64_t>(subcommand, "--levels", options.levels, {0, 50, "0 to 50"},
                              "number of levels; criteria are evaluated anew at each level [1]")
        ->type_name("L");
    add_scheme_option(subcommand, options);
}

CLI::Option* add_scheme_option(CLI::App& subcommand, RefinementOptions& options) {
    return subcommand
        .add_option("--scheme", options.scheme,
                    "edges that a cell marks: all, the longest of each face, or its longest [8t]")
        ->type_name("8t|4t|2t");
}

void add_target_option(CLI::App& subcommand, RefinementOptions& options) {
    add_number(subcommand, "--target-cells", options.target_cells, whole_numbers_from(1),
               "refine by as many levels, at most L, and in the last one as many of the marked\n"
               "cells, those with the longest edges, as make at most N cells [L is 50]")
        ->type_name("N");
}

void complete_levels(const CLI::App& subcommand, RefinementOptions& options) {
    if (options.target_cells && !was_given(subcommand, "levels")) options.levels = 50;
}

void add_closure_option(CLI::App& subcommand, RefinementOptions& options,
                        const std::string& description) {
    subcommand.add_option("--closure", options.closure, description)
        ->type_name("longest-edge|regular");
}

bool was_given(const CLI::App& subcommand, std::string_view name) {
    // Does not use App::count(), which copies names, so that std::bad_alloc would be thrown from a
    // noexcept function.
    const auto options = subcommand.get_options();
    return std::ranges::any_of(options, [&](const CLI::Option* option) {
        return option->count() > 0 && std::ranges::count(option->get_lnames(), name) > 0;
    });
}

bool has_refinement_options(const CLI::App& subcommand) {
    return was_given(subcommand, "levels") || was_given(subcommand, "scheme") ||
           was_given(subcommand, "seed");
}

Scheme parse_scheme(const RefinementOptions& options) {
    constexpr std::array<Word<Scheme>, 3> schemes{
        {{"8t", Scheme::eight}, {"4t", Scheme::four}, {"2t", Scheme::two}}};
    return parse_choice("--scheme", options.scheme, schemes);
}

Closure parse_closure(const RefinementOptions& options) {
    constexpr std::array<Word<Closure>, 2> closures{
        {{"longest-edge", Closure::longest_edge}, {"regular", Closure::regular}}};
    const Closure closure = parse_choice("--closure", options.closure, closures);
    if (closure == Closure::regular && parse_scheme(options) != Scheme::eight) {
        throw InputError("--closure regular requires --scheme 8t");
    }
    return closure;
}

}  // namespace octetra::cli
