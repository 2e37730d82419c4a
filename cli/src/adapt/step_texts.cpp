#include "adapt/step_texts.hpp"

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

std::string sizes_before(std::uint64_t vertices, std::uint64_t cells) {
    return fmt::format("  (before: {}, {})", grouped(vertices), grouped(cells));
}

std::string with_level(std::string_view what, int level, int levels) {
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
