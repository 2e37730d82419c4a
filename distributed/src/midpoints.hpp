#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "closure.hpp"
#include "edge_stars.hpp"

namespace octetra::distributed {

/// The midpoints of a level.
struct Midpoints {
    IndexVector<EdgeIndex, VertexIndex> of_edge;  ///< none() where the edge is not selected
    /// Was each of them, in the order of their numbers, rounded? Where no midpoint of a cell was,
    /// its children fill it exactly.
    std::vector<bool> rounded;
};

/// Bisects the selected edges: appends their midpoints to the mesh's vertices, and their ends,
/// attributes and markers to those lists. In the order of (lower, higher) end.
[[nodiscard]] Midpoints bisect_edges(DistributedMesh& mesh, const EdgeStars& stars,
                                     const Closure& closure);

}  // namespace octetra::distributed
