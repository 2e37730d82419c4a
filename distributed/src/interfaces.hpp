#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "edge_stars.hpp"

namespace octetra::distributed {

/// Collective. What this process shares with others, found once, when a mesh has been distributed;
/// `mesh` is still as the input was. From level to level it follows from what is bisected.
[[nodiscard]] std::vector<Interface> find_interfaces(const DistributedMesh& mesh);

/// The interfaces after a level: halves of bisected edges, pieces of bisected faces, and the edges
/// between those pieces. Both sides come to the same lists without a word. `points` are those of
/// the level before, in which `stars` and `midpoints` (by edge, none() where not bisected) number.
[[nodiscard]] std::vector<Interface> refined_interfaces(
    const std::vector<Interface>& interfaces, const IndexVector<VertexIndex, Point>& points,
    const EdgeStars& stars, const IndexVector<EdgeIndex, VertexIndex>& midpoints);

}  // namespace octetra::distributed
