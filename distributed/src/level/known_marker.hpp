#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Returns the marker of a vertex as far as this process knows it, in a mesh whose vertices have
/// markers.
[[nodiscard]] inline MidpointMarker known_marker(const DistributedMesh& mesh, VertexIndex vertex) {
    const std::size_t input_count = mesh.input_vertices.size();
    if (vertex.value() >= input_count) return mesh.midpoint_markers[vertex.value() - input_count];
    return {MidpointMarker::Source::nothing, mesh.input_vertex_markers[vertex.value()]};
}

/// Returns whether marker a takes precedence over b. Sharers of an edge may know different facets
/// around it: a tagged edge takes precedence over a facet, and a facet over no source; with equal
/// sources the smallest marker wins.
[[nodiscard]] inline bool has_priority_over(const MidpointMarker& a, const MidpointMarker& b) {
    if (a.source != b.source) return a.source > b.source;
    return a.marker < b.marker;
}

}  // namespace octetra::distributed
