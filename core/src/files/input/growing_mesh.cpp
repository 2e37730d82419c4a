#include "files/input/growing_mesh.hpp"

#include <algorithm>

#include <octetra/core/huge_pages.hpp>

namespace octetra {

bool GrowingMesh::means_something(const std::vector<Marker>& markers) const {
    if (!zeros_are_none_) return !markers.empty();
    return std::ranges::any_of(markers, [](Marker m) { return m != 0; });
}

void GrowingMesh::expect_points(std::uint64_t count, std::size_t attributes, bool has_markers) {
    mesh.attributes_per_point = attributes;
    facts_.vertices = count;
    facts_.attributes_per_point = attributes;
    if (is_streaming()) points_stretch_ = MeshSink::longest_stretch / (1 + attributes);
    const std::size_t at_once = std::min<std::size_t>(count, points_stretch_);
    reserve_in_huge_pages(mesh.points, at_once);
    reserve_in_huge_pages(mesh.point_attributes, at_once * attributes);
    reserve_in_huge_pages(mesh.point_markers, has_markers ? at_once : 0);
    if (is_streaming() && streams_points()) sink_->expect_points(count, attributes, has_markers);
}

void GrowingMesh::tell_points() {
    if (!is_streaming() || mesh.points.empty()) return;
    facts_.has_point_markers |= means_something(mesh.point_markers);
    if (streams_points())
        sink_->take_points(mesh.points, mesh.point_attributes, mesh.point_markers);
    mesh.points.clear();
    mesh.point_attributes.clear();
    mesh.point_markers.clear();
}

template <class I, std::size_t N>
void GrowingMesh::expect(const EntityKind<I, N>& kind, std::uint64_t count, bool has_markers) {
    facts_.*kind.count = count;
    if (is_streaming()) entity_stretch_ = MeshSink::longest_stretch;
    const std::size_t at_once = std::min<std::size_t>(count, entity_stretch_);
    reserve_in_huge_pages(mesh.*kind.list, at_once);
    reserve_in_huge_pages(mesh.*kind.markers, has_markers ? at_once : 0);
    if (is_streaming() && streams_others()) (sink_->*kind.expect)(count, has_markers);
}

template <class I, std::size_t N>
void GrowingMesh::tell(const EntityKind<I, N>& kind) {
    auto& list = mesh.*kind.list;
    auto& markers = mesh.*kind.markers;
    if (!is_streaming() || list.empty()) return;
    facts_.*kind.has_markers |= means_something(markers);
    if (streams_others()) (sink_->*kind.take)(list, markers);
    list.clear();
    markers.clear();
}

void GrowingMesh::finish() {
    const bool is_empty = is_streaming() ? facts_.vertices == 0 : mesh.points.empty();
    if (is_empty) mesh.index_base = 0;  // of an empty mesh, whatever the format counts from
    if (is_streaming()) {
        facts_.index_base = mesh.index_base;
        facts_.first_midpoint = facts_.vertices;
        facts_.group_names = SharedGroupNames(mesh.group_names);
        if (streams_others()) sink_->finish(facts_);
        return;
    }
    if (!means_something(mesh.point_markers)) mesh.point_markers = {};
    if (!means_something(mesh.regions)) mesh.regions = {};
    if (!means_something(mesh.facet_markers)) mesh.facet_markers = {};
    if (!means_something(mesh.edge_markers)) mesh.edge_markers = {};
}

template void GrowingMesh::expect(const EntityKind<CellIndex, 4>&, std::uint64_t, bool);
template void GrowingMesh::expect(const EntityKind<FacetIndex, 3>&, std::uint64_t, bool);
template void GrowingMesh::expect(const EntityKind<EdgeIndex, 2>&, std::uint64_t, bool);
template void GrowingMesh::tell(const EntityKind<CellIndex, 4>&);
template void GrowingMesh::tell(const EntityKind<FacetIndex, 3>&);
template void GrowingMesh::tell(const EntityKind<EdgeIndex, 2>&);

}  // namespace octetra
