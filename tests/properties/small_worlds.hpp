#pragma once

#include <vector>

#include <octetra/core/mesh.hpp>

#include "properties/order_classes.hpp"

/// The smallest meshes there are. Coordinates are whole numbers of at most 22 bits, so that worlds
/// can stand side by side in one mesh without changing a length. Those in which the order of edges
/// is exhausted are made in glued_cells.hpp, others in world_search.hpp.
namespace octetra::properties {

/// All worlds in one mesh, each so far along x from the one before, so that they do not meet.
[[nodiscard]] Mesh side_by_side(const std::vector<Mesh>& worlds, double distance);

/// The six edges of a cell (0 to 5, as in cell_edges), longest first.
[[nodiscard]] Order order_of(const Mesh& mesh, CellIndex cell);

}  // namespace octetra::properties
