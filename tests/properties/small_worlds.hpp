#pragma once

#include <vector>

#include <octetra/core/mesh.hpp>

#include "properties/order_classes.hpp"

/// The smallest meshes. Coordinates are whole numbers of at most 22 bits, so that worlds can be
/// placed side by side in one mesh without changing a length. Complexes whose orders of edges are
/// exhausted are in glued_cells.hpp, the others in world_search.hpp.
namespace octetra::properties {

/// Places all worlds in one mesh, each shifted along x by `distance` from the previous one, so that
/// they do not meet.
[[nodiscard]] Mesh side_by_side(const std::vector<Mesh>& worlds, double distance);

/// The six edges of a cell (0 to 5, as in cell_edges), longest first.
[[nodiscard]] Order order_of(const Mesh& mesh, CellIndex cell);

}  // namespace octetra::properties
