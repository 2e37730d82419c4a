#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// The members of a DistributedMesh that record its origin; a mesh whose cells are roots lacks
/// them.
struct History {
    std::vector<GlobalVertex> input_vertices;
    std::vector<Marker> input_vertex_markers;
    std::vector<VertexIndex> level_begin;
    std::vector<EdgeVertices> midpoint_to_edge;
    std::vector<MidpointMarker> midpoint_markers;
    AncestorMap cell_ancestors;
    AncestorMap facet_ancestors;
    AncestorMap edge_ancestors;
    std::uint64_t input_vertex_count = 0;
    std::uint64_t input_cell_count = 0;
    SharedFeatures features;

    void swap_with(DistributedMesh& mesh) noexcept;
};

}  // namespace octetra::distributed
