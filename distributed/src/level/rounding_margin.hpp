#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Is the cell so large for its coordinates that no child can come out flat or inverted, however
/// its edges' midpoints are rounded? Sooner told than the orientation of each child; a no says
/// nothing.
[[nodiscard]] bool has_rounding_margin(const IndexVector<VertexIndex, Point>& points,
                                       const CellVertices& cell);

}  // namespace octetra::distributed
