#include "history/history.hpp"

#include <utility>

namespace octetra::distributed {

void History::swap_with(DistributedMesh& mesh) noexcept {
    std::swap(mesh.input_vertices, input_vertices);
    std::swap(mesh.input_vertex_markers, input_vertex_markers);
    std::swap(mesh.level_begin, level_begin);
    std::swap(mesh.midpoint_to_edge, midpoint_to_edge);
    std::swap(mesh.midpoint_markers, midpoint_markers);
    std::swap(mesh.cell_ancestors, cell_ancestors);
    std::swap(mesh.facet_ancestors, facet_ancestors);
    std::swap(mesh.edge_ancestors, edge_ancestors);
    std::swap(mesh.input_vertex_count, input_vertex_count);
    std::swap(mesh.input_cell_count, input_cell_count);
    std::swap(mesh.features, features);
}

}  // namespace octetra::distributed
