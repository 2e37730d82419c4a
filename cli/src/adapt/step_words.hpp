#pragma once

#include <string>
#include <string_view>
#include <vector>

/// What is said of a step that is done.
namespace octetra::cli {

struct StepDone {
    std::string what;  ///< "refined, 2 levels"
    std::vector<std::string> remarks = {};
    bool changes_mesh = true;
};

/// "refined, 2 levels"
[[nodiscard]] std::string levels_done(std::string_view done, int levels);

/// Why fewer levels than were asked for changed anything; nothing if all did.
[[nodiscard]] std::vector<std::string> idle_levels(int done, int levels, std::string_view reason);

/// Of coarsening, the reason.
[[nodiscard]] std::string_view why_not_coarser(bool is_any_marked);
inline constexpr std::string_view why_not_finer = "no cell was marked";

}  // namespace octetra::cli
