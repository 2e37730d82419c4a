#include "files/input/growing_mesh.hpp"

#include <algorithm>

#include <octetra/core/huge_pages.hpp>

#include "files/input/finish_share.hpp"

namespace octetra {

void GrowingMesh::expect_points(std::uint64_t count, std::size_t attributes, bool has_markers,
                                std::uint64_t room) {
    mesh.attributes_per_point = attributes;
    facts_.vertices = count;
    facts_.attributes_per_point = attributes;
    if (is_streaming()) points_per_block_ = MeshSink::max_batch_size / (1 + attributes);
    const std::size_t at_once = std::min({count, room, std::uint64_t{points_per_block_}});
    reserve_in_huge_pages(mesh.points, at_once);
    reserve_in_huge_pages(mesh.point_attributes, at_once * attributes);
    reserve_in_huge_pages(mesh.point_markers, has_markers ? at_once : 0);
    if (is_streaming() && streams_points()) sink_->expect_points(count, attributes, has_markers);
}

void GrowingMesh::flush_points() {
    if (!is_streaming() || mesh.points.empty()) return;
    facts_.has_point_markers |= are_significant(mesh.point_markers, zeros_are_none_);
    if (streams_points())
        sink_->take_points(mesh.points, mesh.point_attributes, mesh.point_markers);
    mesh.points.clear();
    mesh.point_attributes.clear();
    mesh.point_markers.clear();
}

template <class I, std::size_t N>
void GrowingMesh::expect(const EntityKind<I, N>& kind, std::uint64_t count, bool has_markers,
                         std::uint64_t room) {
    facts_.*kind.count = count;
    if (is_streaming()) entities_per_block_ = MeshSink::max_batch_size;
    const std::size_t at_once = std::min({count, room, std::uint64_t{entities_per_block_}});
    reserve_in_huge_pages(mesh.*kind.list, at_once);
    reserve_in_huge_pages(mesh.*kind.markers, has_markers ? at_once : 0);
    if (is_streaming() && streams_others()) (sink_->*kind.expect)(count, has_markers);
}

template <class I, std::size_t N>
void GrowingMesh::flush(const EntityKind<I, N>& kind) {
    auto& list = mesh.*kind.list;
    auto& markers = mesh.*kind.markers;
    if (!is_streaming() || list.empty()) return;
    facts_.*kind.has_markers |= are_significant(markers, zeros_are_none_);
    if (streams_others()) (sink_->*kind.take)(list, markers);
    list.clear();
    markers.clear();
}

void GrowingMesh::expect_numbers(Feature feature, std::uint64_t count, std::uint64_t room) {
    if (is_streaming()) return;
    facts_.features[feature] = count;
    mesh.features[feature].reserve(std::min(count, room));
}

void GrowingMesh::finish_sink() {
    facts_.index_base = facts_.vertices == 0 ? 0 : mesh.index_base;
    facts_.first_midpoint = facts_.vertices;
    facts_.group_names = SharedGroupNames(mesh.group_names);
    if (streams_others()) sink_->finish(facts_);
}

MeshShare GrowingMesh::finish() {
    MeshShare share;
    facts_.group_names = SharedGroupNames(mesh.group_names);
    share.lists = std::move(mesh);
    finish_share(facts_, zeros_are_none_, *group_, share);
    return share;
}

template void GrowingMesh::expect(const EntityKind<CellIndex, 4>&, std::uint64_t, bool,
                                  std::uint64_t);
template void GrowingMesh::expect(const EntityKind<FacetIndex, 3>&, std::uint64_t, bool,
                                  std::uint64_t);
template void GrowingMesh::expect(const EntityKind<EdgeIndex, 2>&, std::uint64_t, bool,
                                  std::uint64_t);
template void GrowingMesh::flush(const EntityKind<CellIndex, 4>&);
template void GrowingMesh::flush(const EntityKind<FacetIndex, 3>&);
template void GrowingMesh::flush(const EntityKind<EdgeIndex, 2>&);

}  // namespace octetra
