#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/transition_cells.hpp"

namespace octetra::distributed {

/// Collective, within a transaction. Puts the vertices of a mesh, which are in the order in which
/// they were made, into canonical order, that of their generations, and renumbers all lists. Within
/// each generation, the midpoints made before the last step are in canonical order already, and
/// precede those that the step has appended. Returns the new number of each vertex.
[[nodiscard]] IndexVector<VertexIndex, VertexIndex> order_by_generation(
    DistributedMesh& mesh, const TransitionCells::Generations& generations);

}  // namespace octetra::distributed
