#pragma once

#include "properties/case.hpp"
#include "properties/draw.hpp"

namespace octetra::properties {

/// A case for up to `ranks` ranks, the larger the greater `size` (0 to 100). The more cells, the
/// fewer levels. `exact`: by draw_exact_mesh, and every number in the selection on its grid, too.
[[nodiscard]] Case draw_case(Draw& draw, int size, int ranks, bool exact);

/// Adds a random criterion of cells of this mesh.
void add_criterion(Selection& selection, const Mesh& mesh, Draw& draw);

/// What is degenerate or rare about a case, in words: "ties", "slivers", "empty ranks" ...
[[nodiscard]] std::vector<std::string> tags_of(const Case& c, int ranks);

/// All that tags_of can say.
[[nodiscard]] const std::vector<std::string>& all_tags();

}  // namespace octetra::properties
