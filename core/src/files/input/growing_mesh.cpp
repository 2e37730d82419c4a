#include "files/input/growing_mesh.hpp"

#include <algorithm>

#include <octetra/core/huge_pages.hpp>

namespace octetra {

bool GrowingMesh::is_significant(const std::vector<Marker>& markers) const {
    if (!zeros_are_none_) return !markers.empty();
    return std::ranges::any_of(markers, [](Marker m) { return m != 0; });
}

void GrowingMesh::expect_points(std::uint64_t count, std::size_t attributes, bool has_markers) {
    mesh.attributes_per_point = attributes;
    facts_.vertices = count;
    facts_.attributes_per_point = attributes;
    if (is_streaming()) points_per_block_ = MeshSink::max_batch_size / (1 + attributes);
    const std::size_t at_once = std::min<std::size_t>(count, points_per_block_);
    reserve_in_huge_pages(mesh.points, at_once);
    reserve_in_huge_pages(mesh.point_attributes, at_once * attributes);
    reserve_in_huge_pages(mesh.point_markers, has_markers ? at_once : 0);
    if (is_streaming() && streams_points()) sink_->expect_points(count, attributes, has_markers);
}

void GrowingMesh::flush_points() {
    if (!is_streaming() || mesh.points.empty()) return;
    facts_.has_point_markers |= is_significant(mesh.point_markers);
    if (streams_points())
        sink_->take_points(mesh.points, mesh.point_attributes, mesh.point_markers);
    mesh.points.clear();
    mesh.point_attributes.clear();
    mesh.point_markers.clear();
}

template <class I, std::size_t N>
void GrowingMesh::expect(const EntityKind<I, N>& kind, std::uint64_t count, bool has_markers) {
    facts_.*kind.count = count;
    if (is_streaming()) entities_per_block_ = MeshSink::max_batch_size;
    const std::size_t at_once = std::min<std::size_t>(count, entities_per_block_);
    reserve_in_huge_pages(mesh.*kind.list, at_once);
    reserve_in_huge_pages(mesh.*kind.markers, has_markers ? at_once : 0);
    if (is_streaming() && streams_others()) (sink_->*kind.expect)(count, has_markers);
}

template <class I, std::size_t N>
void GrowingMesh::flush(const EntityKind<I, N>& kind) {
    auto& list = mesh.*kind.list;
    auto& markers = mesh.*kind.markers;
    if (!is_streaming() || list.empty()) return;
    facts_.*kind.has_markers |= is_significant(markers);
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
    if (!is_significant(mesh.point_markers)) mesh.point_markers = {};
    if (!is_significant(mesh.regions)) mesh.regions = {};
    if (!is_significant(mesh.facet_markers)) mesh.facet_markers = {};
    if (!is_significant(mesh.edge_markers)) mesh.edge_markers = {};
}

template void GrowingMesh::expect(const EntityKind<CellIndex, 4>&, std::uint64_t, bool);
template void GrowingMesh::expect(const EntityKind<FacetIndex, 3>&, std::uint64_t, bool);
template void GrowingMesh::expect(const EntityKind<EdgeIndex, 2>&, std::uint64_t, bool);
template void GrowingMesh::flush(const EntityKind<CellIndex, 4>&);
template void GrowingMesh::flush(const EntityKind<FacetIndex, 3>&);
template void GrowingMesh::flush(const EntityKind<EdgeIndex, 2>&);

}  // namespace octetra
