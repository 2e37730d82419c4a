#include <octetra/core/mesh_source.hpp>

namespace octetra {
WholeMesh::WholeMesh(const Mesh& mesh, const RefinementMaps* maps)
    : mesh_(&mesh),
      maps_(maps),
      facts_{.vertices = mesh.points.size(),
             .cells = mesh.cells.size(),
             .facets = mesh.facets.size(),
             .edges = mesh.edges.size(),
             .attributes_per_point = mesh.attributes_per_point,
             .index_base = mesh.index_base,
             .first_midpoint = maps == nullptr ? mesh.points.size() : maps->first_midpoint.value(),
             .has_point_markers = !mesh.point_markers.empty(),
             .has_regions = !mesh.regions.empty(),
             .has_facet_markers = !mesh.facet_markers.empty(),
             .has_edge_markers = !mesh.edge_markers.empty(),
             .has_parents = maps != nullptr} {}

std::span<const Point> WholeMesh::points(const Window& w) { return slice(mesh_->points, w); }
std::span<const Marker> WholeMesh::point_markers(const Window& w) {
    return slice(mesh_->point_markers, w);
}
std::span<const double> WholeMesh::point_attributes(const Window& w) {
    return slice(mesh_->point_attributes, w, mesh_->attributes_per_point);
}
std::span<const EdgeVertices> WholeMesh::midpoint_ends(const Window& w) {
    return slice(maps_->midpoint_to_edge, w);
}
std::span<const CellVertices> WholeMesh::cells(const Window& w) { return slice(mesh_->cells, w); }
std::span<const Marker> WholeMesh::regions(const Window& w) { return slice(mesh_->regions, w); }
std::span<const CellIndex> WholeMesh::parents(const Window& w) {
    return slice(maps_->cell_to_parent, w);
}
std::span<const FacetVertices> WholeMesh::facets(const Window& w) {
    return slice(mesh_->facets, w);
}
std::span<const Marker> WholeMesh::facet_markers(const Window& w) {
    return slice(mesh_->facet_markers, w);
}
std::span<const EdgeVertices> WholeMesh::edges(const Window& w) { return slice(mesh_->edges, w); }
std::span<const Marker> WholeMesh::edge_markers(const Window& w) {
    return slice(mesh_->edge_markers, w);
}

}  // namespace octetra
