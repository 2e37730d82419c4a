#pragma once

#include "properties/case.hpp"
#include "properties/draw.hpp"

namespace octetra::properties {

/// Draws a history of 2 to 12 steps, of which the first refines, for at most `ranks` ranks. Its
/// mesh grows with `size` (0 to 100). `exact`: the mesh is drawn by draw_exact_mesh.
[[nodiscard]] Case draw_history(Draw& draw, int size, int ranks, bool exact);

/// Names what occurs in a history: "coarser", "finer after coarser", "refused for rounding" ...
[[nodiscard]] std::vector<std::string> tags_of_history(const Case& c, int ranks);

/// All tags that tags_of_history() can return.
[[nodiscard]] const std::vector<std::string>& all_tags_of_histories();

}  // namespace octetra::properties
