#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Returns whether the cell is so large relative to its coordinates that no child can become flat
/// or inverted by the rounding of midpoints. Cheaper than the orientations of all children; a
/// negative result proves nothing.
[[nodiscard]] bool has_rounding_margin(const IndexVector<VertexIndex, Point>& points,
                                       const CellVertices& cell);

}  // namespace octetra::distributed
