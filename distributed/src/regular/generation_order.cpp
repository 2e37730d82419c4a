#include "regular/generation_order.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace octetra::distributed {
namespace {

using NumbersAfter = IndexVector<VertexIndex, VertexIndex>;

/// Returns the midpoints of each generation, from 1 to `last`.
std::vector<std::vector<VertexIndex>> by_generation(const TransitionCells::Generations& generations,
                                                    std::uint64_t last) {
    std::vector<std::vector<VertexIndex>> lists(last);
    for (VertexIndex v{0}; v < generations.end_index(); ++v) {
        if (generations[v] > 0) lists[generations[v] - 1].push_back(v);
    }
    return lists;
}

EdgeVertices renumbered(const EdgeVertices& edge, const NumbersAfter& after) {
    const auto& [low, high] = std::minmax(after[edge[0]], after[edge[1]]);
    return {low, high};
}

/// Returns the list in the new order, with `components` values for each vertex from `first` on.
template <class T>
std::vector<T> permuted(const std::vector<T>& list, const NumbersAfter& after,
                        std::size_t components = 1, std::size_t first = 0) {
    std::vector<T> result(list.size());
    for (std::size_t v = first; v * components < list.size() + first * components; ++v) {
        const std::size_t to = after[VertexIndex{v}].value() - first;
        std::copy_n(list.begin() + static_cast<std::ptrdiff_t>((v - first) * components),
                    components, result.begin() + static_cast<std::ptrdiff_t>(to * components));
    }
    return result;
}

void renumber(auto& entities, const NumbersAfter& after) {
    for (auto& entity : entities) {
        for (VertexIndex& v : entity) v = after[v];
    }
}

void renumber(DistributedMesh& mesh, const NumbersAfter& after) {
    const std::size_t input_count = mesh.input_vertices.size();
    const std::vector<Point> points = permuted<Point>(mesh.points, after);
    mesh.points.assign(points.begin(), points.end());
    if (mesh.attributes_per_point > 0) {
        mesh.point_attributes = permuted(mesh.point_attributes, after, mesh.attributes_per_point);
    }
    for (EdgeVertices& edge : mesh.midpoint_to_edge) edge = renumbered(edge, after);
    mesh.midpoint_to_edge = permuted(mesh.midpoint_to_edge, after, 1, input_count);
    mesh.midpoint_markers = permuted(mesh.midpoint_markers, after, 1, input_count);
    renumber(mesh.cells, after);
    renumber(mesh.facets, after);
    renumber(mesh.edges, after);
    for (Interface& interface : mesh.interfaces) {
        renumber(interface.edges, after);
        renumber(interface.faces, after);
    }
}

}  // namespace

NumbersAfter order_by_generation(DistributedMesh& mesh,
                                 const TransitionCells::Generations& generations) {
    const std::uint32_t newest = generations.empty() ? 0 : *std::ranges::max_element(generations);
    auto lists = by_generation(generations, mesh.processes.max(newest));
    NumbersAfter after;
    after.reserve(mesh.points.size());
    for (std::size_t v = 0; v < mesh.input_vertices.size(); ++v) after.append(VertexIndex{v});
    after.resize(mesh.points.size(), VertexIndex::none());
    VertexIndex next{mesh.input_vertices.size()};
    mesh.level_begin.clear();
    for (std::vector<VertexIndex>& list : lists) {
        const auto ends_of = [&](VertexIndex v) {
            return renumbered(mesh.midpoint_to_edge[v.value() - mesh.input_vertices.size()], after);
        };
        const auto precedes = [&](VertexIndex v, VertexIndex w) { return ends_of(v) < ends_of(w); };
        const auto appended = std::ranges::is_sorted_until(list, precedes);
        std::sort(appended, list.end(), precedes);
        std::inplace_merge(list.begin(), appended, list.end(), precedes);
        mesh.level_begin.push_back(next);
        for (const VertexIndex v : list) {
            after[v] = next;
            ++next;
        }
    }
    renumber(mesh, after);
    return after;
}

}  // namespace octetra::distributed
