#include <octetra/core/mesh_source.hpp>

#include <utility>

namespace octetra {
namespace {

std::uint64_t number_of(CellIndex cell) { return cell.value(); }

template <std::size_t N>
VertexNumbers<N> number_of(const std::array<VertexIndex, N>& vertices) {
    VertexNumbers<N> numbers;
    for (std::size_t k = 0; k < N; ++k) numbers[k] = vertices[k].value();
    return numbers;
}

/// Returns a slice of a list, with 64-bit numbers.
auto numbered(const auto& list, const Window& window, auto& numbers) {
    const auto entities = slice(list, window);
    numbers.resize(entities.size());
    for (std::size_t i = 0; i < entities.size(); ++i) numbers[i] = number_of(entities[i]);
    return std::span(std::as_const(numbers));
}

}  // namespace

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
             .has_parents = maps != nullptr,
             .group_names = SharedGroupNames(mesh.group_names)} {
    for (const Feature f : all_features) facts_.features[f] = mesh.features[f].size();
}

std::span<const Point> WholeMesh::points(const Window& w) { return slice(mesh_->points, w); }
std::span<const Marker> WholeMesh::point_markers(const Window& w) {
    return slice(mesh_->point_markers, w);
}
std::span<const double> WholeMesh::point_attributes(const Window& w) {
    return slice(mesh_->point_attributes, w, mesh_->attributes_per_point);
}
std::span<const VertexNumbers<2>> WholeMesh::midpoint_ends(const Window& w) {
    return numbered(maps_->midpoint_to_edge, w, midpoint_ends_);
}
std::span<const VertexNumbers<4>> WholeMesh::cells(const Window& w) {
    return numbered(mesh_->cells, w, cells_);
}
std::span<const Marker> WholeMesh::regions(const Window& w) { return slice(mesh_->regions, w); }
std::span<const std::uint64_t> WholeMesh::parents(const Window& w) {
    return numbered(maps_->cell_to_parent, w, parents_);
}
std::span<const VertexNumbers<3>> WholeMesh::facets(const Window& w) {
    return numbered(mesh_->facets, w, facets_);
}
std::span<const Marker> WholeMesh::facet_markers(const Window& w) {
    return slice(mesh_->facet_markers, w);
}
std::span<const VertexNumbers<2>> WholeMesh::edges(const Window& w) {
    return numbered(mesh_->edges, w, edges_);
}
std::span<const Marker> WholeMesh::edge_markers(const Window& w) {
    return slice(mesh_->edge_markers, w);
}
std::span<const std::uint64_t> WholeMesh::features(Feature f, const Window& w) {
    return slice(mesh_->features[f], w);
}

}  // namespace octetra
