#pragma once

#include "properties/case.hpp"
#include "properties/draw.hpp"

namespace octetra::properties {

/// A history of 2 to 12 steps for up to `ranks` ranks, the first of which refines; its mesh is the
/// larger the greater `size` (0 to 100). `exact`: by draw_exact_mesh.
[[nodiscard]] Case draw_history(Draw& draw, int size, int ranks, bool exact);

/// What happens in a history, in words: "coarser", "finer after coarser", "refused for rounding"
/// ...
[[nodiscard]] std::vector<std::string> tags_of_history(const Case& c, int ranks);

/// All that tags_of_history can say.
[[nodiscard]] const std::vector<std::string>& all_tags_of_histories();

}  // namespace octetra::properties
