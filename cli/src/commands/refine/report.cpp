#include "commands/refine/report.hpp"

#include <fmt/format.h>

#include "commands/report_line.hpp"
#include "grouped.hpp"

namespace octetra::cli {
namespace {

std::string refined_line(int levels, int ranks) {
    const std::string line = fmt::format("refined, {} level{}", levels, levels == 1 ? "" : "s");
    return ranks == 1 ? line : fmt::format("{}, {} ranks", line, ranks);
}

/// Prints a note if fewer levels than requested changed the mesh.
void note_idle_levels(const RefineOptions& options, int levels) {
    if (options.refinement.levels == 0) return note("--levels 0: the mesh is unchanged");
    if (levels == options.refinement.levels) return;
    note(levels == 0 ? "no cell was marked: the mesh is unchanged"
                     : fmt::format("no cell was marked any more after level {} of {}", levels,
                                   options.refinement.levels));
}

}  // namespace

void report(const RefineOptions& options, std::string_view doing, std::uint64_t vertices,
            std::uint64_t cells, double seconds) {
    report_line(options.quiet, doing, vertices, cells, seconds);
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
