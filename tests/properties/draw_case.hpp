#pragma once

#include "properties/case.hpp"
#include "properties/draw.hpp"

namespace octetra::properties {

/// Draws a case for at most `ranks` ranks. Its mesh grows with `size` (0 to 100), and the number of
/// levels shrinks with the number of cells. `exact`: the mesh is drawn by draw_exact_mesh, and all
/// numbers of the selection lie on its grid.
[[nodiscard]] Case draw_case(Draw& draw, int size, int ranks, bool exact);

/// Adds a random criterion that suits this mesh.
void add_criterion(Selection& selection, const Mesh& mesh, Draw& draw);

/// Names the degenerate or rare properties of a case: "ties", "slivers", "empty ranks" ...
[[nodiscard]] std::vector<std::string> tags_of(const Case& c, int ranks);

/// All tags that tags_of() can return.
[[nodiscard]] const std::vector<std::string>& all_tags();

}  // namespace octetra::properties
