#include "adapt/step_texts.hpp"

#include <utility>

#include <fmt/format.h>

#include "grouped.hpp"

namespace octetra::cli {

StepDone step_written(const std::string& path, const std::string& lost) {
    StepDone done{.what = fmt::format("wrote {}", path), .changes_mesh = false};
    if (!lost.empty()) done.remarks.push_back(lost);
    return done;
}

std::string levels_done(std::string_view done, int levels) {
    return fmt::format("{}, {} level{}", done, levels, levels == 1 ? "" : "s");
}

std::string steps_fitted(int refined, int coarsened) {
    if (refined + coarsened == 0) return "fitted already";
    return fmt::format("fitted, {} level{} refined, {} coarsened", refined, refined == 1 ? "" : "s",
                       coarsened);
}

std::vector<std::string> misfits_of(const distributed::MisfitCells& misfits, bool has_history) {
    const auto cells = [](std::uint64_t count, std::string_view is, std::string_view are) {
        return fmt::format("{} cell{}", grouped(count), count == 1 ? is : are);
    };
    std::vector<std::string> remarks;
    if (misfits.too_long > 0) {
        remarks.push_back(cells(misfits.too_long, " is", "s are") +
                          " longer than the target size: more --levels are needed");
    }
    if (misfits.too_short == 0) return remarks;
    std::string remark =
        cells(misfits.too_short, " is", "s are") + " shorter than half the target size: ";
    const std::uint64_t kept = misfits.too_short - misfits.too_short_roots;
    if (misfits.too_short_roots > 0) {
        remark += cells(misfits.too_short_roots, "", "s") +
                  (has_history ? " of the input" : " of the input, which has no history");
    }
    if (kept > 0) {
        if (misfits.too_short_roots > 0) remark += ", and ";
        remark += cells(kept, "", "s") +
                  " that cannot be merged: a cell would be too long, or the mesh "
                  "not conforming";
    }
    remarks.push_back(std::move(remark));
    return remarks;
}

std::string reached_target(std::uint64_t refined, std::uint64_t marked) {
    return fmt::format(
        "--target-cells: the last level refined {} of the {} marked cells, those "
        "with the longest edges",
        grouped(refined), grouped(marked));
}

std::string sizes_before(std::uint64_t vertices, std::uint64_t cells) {
    return fmt::format("  (before: {}, {})", grouped(vertices), grouped(cells));
}

std::string with_level(std::string_view what, int level, int levels) {
    constexpr std::string_view word = "level ";
    const std::size_t named = what.find(word);
    const bool is_numbered = named != std::string_view::npos &&
                             what.find_first_of("0123456789", named) == named + word.size();
    if (!is_numbered) return std::string(what);
    return fmt::format(
        "{} (levels count all steps that have made this mesh; this is level {} of {} here)", what,
        level, levels);
}

std::vector<std::string> idle_levels(int done, int levels, std::string_view reason) {
    if (levels == 0) return {"--levels 0: the mesh is unchanged"};
    if (done == levels) return {};
    if (done == 0) return {fmt::format("{}: the mesh is unchanged", reason)};
    return {fmt::format("{} any more after level {} of {}", reason, done, levels)};
}

std::string_view idle_coarsening_reason(bool is_refined, bool is_any_marked) {
    if (!is_refined) {
        return "the mesh has no refinement history, which only a checkpoint (.octetra) keeps";
    }
    return is_any_marked ? "no vertex could be removed" : "no cell was marked";
}

}  // namespace octetra::cli
