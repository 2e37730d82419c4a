#pragma once

#include <array>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/full_sweep/edge_numbering.hpp"
#include "level/full_sweep/full_sweep_closure.hpp"

namespace octetra::distributed {

/// Returns the midpoints of a triangle's edges, in the order of triangle_edges.
[[nodiscard]] inline std::array<VertexIndex, 3> midpoints_of(
    const FacetVertices& triangle, const EdgeNumbering& numbering,
    const IndexVector<EdgeIndex, VertexIndex>& midpoints) {
    std::array<VertexIndex, 3> result;
    for (std::size_t e = 0; e < 3; ++e) {
        const auto [i, j] = triangle_edges[e];
        result[e] = midpoints[numbering.find(triangle[i], triangle[j])];
    }
    return result;
}

/// Bisects the marked edges in the order of (lower, higher) end: appends their midpoints, ends,
/// attributes and markers to the mesh's lists. Returns the midpoint of each edge, none() for
/// unmarked ones.
[[nodiscard]] IndexVector<EdgeIndex, VertexIndex> bisect_edges(DistributedMesh& mesh,
                                                               const EdgeNumbering& numbering,
                                                               const FullSweepClosure& closure);

}  // namespace octetra::distributed
