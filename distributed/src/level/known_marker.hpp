#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// What this process knows of the marker of a vertex, of a mesh whose vertices have markers.
[[nodiscard]] inline MidpointMarker known_marker(const DistributedMesh& mesh, VertexIndex vertex) {
    const std::size_t input_count = mesh.input_vertices.size();
    if (vertex.value() >= input_count) return mesh.midpoint_markers[vertex.value() - input_count];
    return {MidpointMarker::Source::nothing, mesh.input_vertex_markers[vertex.value()]};
}

/// Processes that share an edge may know of different facets around it. A tagged edge tells more
/// than a facet, a facet more than nothing; among equals the smallest marker counts.
[[nodiscard]] inline bool tells_more(const MidpointMarker& a, const MidpointMarker& b) {
    if (a.source != b.source) return a.source > b.source;
    return a.marker < b.marker;
}

}  // namespace octetra::distributed
