#include "commands/refine/report.hpp"

#include <unistd.h>

#include <cstdio>

#include <fmt/format.h>

#include "grouped.hpp"
#include "terminal.hpp"

namespace octetra::cli {
namespace {

std::string refined_line(int levels, int ranks) {
    const std::string line = fmt::format("refined, {} level{}", levels, levels == 1 ? "" : "s");
    return ranks == 1 ? line : fmt::format("{}, {} ranks", line, ranks);
}

/// Says so where there was less to do than was asked for, or more is left than there may seem.
void note_idle_levels(const RefineOptions& options, int levels) {
    if (options.refinement.levels == 0) return note("--levels 0: the mesh stays as it is");
    if (levels == options.refinement.levels) return;
    note(levels == 0 ? std::string("no cell was marked: the mesh stays as it is")
                     : fmt::format("no cell was marked any more after level {} of {}", levels,
                                   options.refinement.levels));
}

}  // namespace

void report(const RefineOptions& options, std::string_view doing, std::uint64_t vertices,
            std::uint64_t cells, double seconds) {
    if (options.quiet) return;
    print("{:<30} {:>13} vertices {:>13} cells {:>8.2f} s\n", doing, grouped(vertices),
          grouped(cells), seconds);
    std::fflush(stdout);
}

std::function<void(int, std::uint64_t)> level_progress(const RefineOptions& options) {
    if (options.quiet || ::isatty(STDERR_FILENO) == 0) return {};
    return [levels = options.refinement.levels](int level, std::uint64_t cells) {
        print_error_text(fmt::format("\rlevel {} of {}: {} cells ", level, levels, grouped(cells)));
    };
}

void report_refined(const RefineOptions& options, const RefinedFacts& refined, double seconds) {
    report(options, refined_line(refined.levels, refined.ranks), refined.facts.vertices,
           refined.facts.cells, seconds);
    note_idle_levels(options, refined.levels);
    if (refined.too_large == 0) return;
    note(fmt::format("{} cell{} larger than --max-volume after {} level{}: more --levels may help",
                     grouped(refined.too_large), refined.too_large == 1 ? " is" : "s are",
                     refined.levels, refined.levels == 1 ? "" : "s"));
}

void report_written(const RefineOptions& options, const std::string& lost, const MeshFacts& facts,
                    double seconds) {
    if (!lost.empty()) note(lost);
    report(options, fmt::format("wrote {}", options.output), facts.vertices, facts.cells, seconds);
}

}  // namespace octetra::cli
