#pragma once

#include <octetra/core/mesh.hpp>

#include "pattern/patterns.hpp"

namespace octetra::distributed {

/// Returns the order of a cell's edges by length, in the strict order of core/edge_order.hpp.
[[nodiscard]] LengthOrder length_order(const IndexVector<VertexIndex, Point>& points,
                                       const CellVertices& cell);

}  // namespace octetra::distributed
