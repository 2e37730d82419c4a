#pragma once

#include <array>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "dense_closure.hpp"
#include "edge_stars.hpp"

namespace octetra::distributed {

/// Appends the midpoint of an edge to the mesh's vertices, and its ends and attributes to those
/// lists; not its marker.
void append_midpoint(DistributedMesh& mesh, VertexIndex low, VertexIndex high);

/// Learns that the edge of a midpoint is listed, or in a listed facet, with this marker: an edge
/// tells more than a facet, a facet more than nothing; among equals the smallest marker counts.
void take_marker(MidpointMarker& known, MidpointMarker::Source source, Marker marker);

/// The midpoints of a triangle's edges, in the order of triangle_edges.
[[nodiscard]] inline std::array<VertexIndex, 3> midpoints_of(
    const FacetVertices& triangle, const EdgeStars& stars,
    const IndexVector<EdgeIndex, VertexIndex>& midpoints) {
    std::array<VertexIndex, 3> result;
    for (std::size_t e = 0; e < 3; ++e) {
        const auto [i, j] = triangle_edges[e];
        result[e] = midpoints[stars.find(triangle[i], triangle[j])];
    }
    return result;
}

/// Bisects the selected edges: appends their midpoints to the mesh's vertices, and their ends,
/// attributes and markers to those lists. In the order of (lower, higher) end. Returns the midpoint
/// of each edge, none() where it is not selected.
[[nodiscard]] IndexVector<EdgeIndex, VertexIndex> bisect_edges(DistributedMesh& mesh,
                                                               const EdgeStars& stars,
                                                               const DenseClosure& closure);

}  // namespace octetra::distributed
