#pragma once

#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>

namespace octetra::distributed {

/// About how many cells each cell of the mesh becomes in so many levels: what partition_cells() is
/// to weigh them by, so that the process that has the refined place does not get nearly all of the
/// result. Empty where all become equally many, or nothing tells which become more. Not collective.
///
/// A marked cell becomes 8, 4 or 2 in each level, by the scheme, and 1e9 at most. Of a sphere or
/// box it counts how much of a cell is inside, as closure leads there what is not marked itself; a
/// random share is as large everywhere. What closure does around the marked cells is left out: it
/// is little beside them.
[[nodiscard]] std::vector<float> predicted_cells(const Mesh& mesh, const Selection& selection,
                                                 Scheme scheme, int levels);

}  // namespace octetra::distributed
