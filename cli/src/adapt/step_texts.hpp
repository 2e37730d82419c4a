#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/distributed/fit.hpp>

/// Texts of the report on a step.
namespace octetra::cli {

struct StepDone {
    std::string what;  ///< "refined, 2 levels"
    std::vector<std::string> remarks = {};
    bool changes_mesh = true;
};

/// Returns the report of a step that wrote a file. `lost` names the data that its format cannot
/// hold, or is empty.
[[nodiscard]] StepDone step_written(const std::string& path, const std::string& lost);

/// Returns "refined, 2 levels" etc.
[[nodiscard]] std::string levels_done(std::string_view done, int levels);

/// Returns "fitted, 3 levels refined, 1 coarsened".
[[nodiscard]] std::string steps_fitted(int refined, int coarsened);

/// Returns what does not fit after a fit, and why; nothing if all cells fit.
[[nodiscard]] std::vector<std::string> misfits_of(const distributed::MisfitCells& misfits,
                                                  bool has_history);

/// Returns the note about a step with --target-cells whose last level refined only a part of the
/// marked cells.
[[nodiscard]] std::string reached_target(std::uint64_t refined, std::uint64_t marked);

/// Returns "  (before: 1,026, 3,103)", given the numbers of vertices and cells.
[[nodiscard]] std::string sizes_before(std::uint64_t vertices, std::uint64_t cells);

/// Returns the message of an error in a level of a step that is not the first of a script.
[[nodiscard]] std::string with_level(std::string_view what, int level, int levels);

inline constexpr std::string_view regular_history_is_lost =
    "the bounds of the regular closure hold for refinements that continue from a checkpoint "
    "(-o FILE.octetra); this file does not hold the history";

/// Returns the reason why fewer levels than requested changed the mesh; nothing if all did.
[[nodiscard]] std::vector<std::string> idle_levels(int done, int levels, std::string_view reason);

/// Returns the reason for coarsening. `is_refined`: whether the mesh has a history.
[[nodiscard]] std::string_view idle_coarsening_reason(bool is_refined, bool is_any_marked);
inline constexpr std::string_view idle_refinement_reason = "no cell was marked";

}  // namespace octetra::cli
