#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// All that a mesh tells of where it comes from: what is left out of one whose cells are roots.
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
