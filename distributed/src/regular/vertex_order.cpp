#include "regular/vertex_order.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <octetra/core/huge_pages.hpp>

namespace octetra::distributed {
namespace {

using NumbersAfter = IndexVector<VertexIndex, VertexIndex>;

/// Returns the new midpoints of each generation, from 1 to `last`.
std::vector<std::vector<VertexIndex>> by_generation(VertexIndex first,
                                                    const TransitionCells::Generations& generations,
                                                    std::uint64_t last) {
    std::vector<std::vector<VertexIndex>> lists(last);
    for (VertexIndex v = first; v < generations.end_index(); ++v) {
        lists[generations[v] - 1].push_back(v);
    }
    return lists;
}

EdgeVertices renumbered(const EdgeVertices& edge, const NumbersAfter& after) {
    const auto& [low, high] = std::minmax(after[edge[0]], after[edge[1]]);
    return {low, high};
}

/// Returns the list in the new order, with `components` values for each vertex from `first` on.
template <class List>
List permuted(const List& list, const NumbersAfter& after, std::size_t components = 1,
              std::size_t first = 0) {
    List result;
    reserve_with_room(result, list.size());
    result.resize(list.size());
    for (std::size_t v = first; (v - first) * components < list.size(); ++v) {
        const std::size_t to = after[VertexIndex{v}].value() - first;
        std::copy_n(list.begin() + static_cast<std::ptrdiff_t>((v - first) * components),
                    components, result.begin() + static_cast<std::ptrdiff_t>(to * components));
    }
    return result;
}

void renumber(auto& entities, const NumbersAfter& after) noexcept {
    for (auto& entity : entities) {
        for (VertexIndex& v : entity) v = after[v];
    }
}

}  // namespace

VertexOrder::VertexOrder(const DistributedMesh& mesh, const Before& before,
                         const TransitionCells::Generations& generations) {
    find_order(mesh, before, generations);
    for (VertexIndex v = before.end; v < after.end_index() && !is_changed; ++v) {
        is_changed = after[v] != v;
    }
    if (is_changed) {
        copy_lists(mesh);
    } else {
        after = {};
    }
}

void VertexOrder::find_order(const DistributedMesh& mesh, const Before& before,
                             const TransitionCells::Generations& generations) {
    const std::size_t input_count = mesh.input_vertices.size();
    std::uint32_t newest = static_cast<std::uint32_t>(before.level_begin.size());
    for (VertexIndex v = before.end; v < generations.end_index(); ++v) {
        newest = std::max(newest, generations[v]);
    }
    const std::uint64_t last = mesh.processes.max(newest);
    const auto added = by_generation(before.end, generations, last);
    const auto begin_before = [&](std::size_t level) {
        return level < before.level_begin.size() ? before.level_begin[level] : before.end;
    };
    after.resize(mesh.points.size());
    for (std::size_t v = 0; v < input_count; ++v) after[VertexIndex{v}] = VertexIndex{v};
    VertexIndex next{input_count};
    const auto ends_of = [&](VertexIndex v) {
        return renumbered(mesh.midpoint_to_edge[v.value() - input_count], after);
    };
    const auto precedes = [&](VertexIndex v, VertexIndex w) { return ends_of(v) < ends_of(w); };
    const auto number = [&](VertexIndex v) {
        after[v] = next;
        ++next;
    };
    for (std::size_t level = 0; level < last; ++level) {
        level_begin.push_back(next);
        auto sorted = added[level];
        std::ranges::sort(sorted, precedes);
        VertexIndex old = begin_before(level);
        const VertexIndex end = begin_before(level + 1);
        for (const VertexIndex v : sorted) {
            while (old < end && precedes(old, v)) {
                number(old);
                ++old;
            }
            number(v);
        }
        for (; old < end; ++old) number(old);
    }
}

void VertexOrder::copy_lists(const DistributedMesh& mesh) {
    const std::size_t input_count = mesh.input_vertices.size();
    points = permuted(mesh.points, after);
    if (mesh.attributes_per_point > 0) {
        point_attributes = permuted(mesh.point_attributes, after, mesh.attributes_per_point);
    }
    midpoint_to_edge = permuted(mesh.midpoint_to_edge, after, 1, input_count);
    for (EdgeVertices& edge : midpoint_to_edge) edge = renumbered(edge, after);
    midpoint_markers = permuted(mesh.midpoint_markers, after, 1, input_count);
    if (mesh.adjacency == nullptr || !mesh.adjacency->has_index) return;
    cells_ = mesh.adjacency->cells.incidence().renumbered(after);
    facets_ = mesh.adjacency->facets.incidence().renumbered(after);
    edges_ = mesh.adjacency->edges.incidence().renumbered(after);
    shared_edges_ = mesh.adjacency->shared_edges.incidence().renumbered(after);
    shared_faces_ = mesh.adjacency->shared_faces.incidence().renumbered(after);
}

std::span<const EdgeVertices> VertexOrder::midpoint_ends(const DistributedMesh& mesh,
                                                         std::size_t level) const {
    const std::span<const EdgeVertices> all = is_changed ? midpoint_to_edge : mesh.midpoint_to_edge;
    const std::size_t input_count = mesh.input_vertices.size();
    const std::size_t begin = level_begin[level].value() - input_count;
    const std::size_t end =
        level + 1 < level_begin.size() ? level_begin[level + 1].value() - input_count : all.size();
    return all.subspan(begin, end - begin);
}

void VertexOrder::commit(DistributedMesh& mesh) noexcept {
    mesh.level_begin.swap(level_begin);
    if (!is_changed) return;
    mesh.points.swap(points);
    mesh.point_attributes.swap(point_attributes);
    mesh.midpoint_to_edge.swap(midpoint_to_edge);
    mesh.midpoint_markers.swap(midpoint_markers);
    renumber(mesh.cells, after);
    renumber(mesh.facets, after);
    renumber(mesh.edges, after);
    for (Interface& interface : mesh.interfaces) {
        renumber(interface.edges, after);
        renumber(interface.faces, after);
    }
    if (mesh.adjacency == nullptr || !mesh.adjacency->has_index) return;
    mesh.adjacency->cells.incidence().set_heads(std::move(cells_));
    mesh.adjacency->facets.incidence().set_heads(std::move(facets_));
    mesh.adjacency->edges.incidence().set_heads(std::move(edges_));
    mesh.adjacency->shared_edges.incidence().set_heads(std::move(shared_edges_));
    mesh.adjacency->shared_faces.incidence().set_heads(std::move(shared_faces_));
}

}  // namespace octetra::distributed
