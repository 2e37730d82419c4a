#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// For each tagged facet or edge of a mesh the one of a coarser mesh that it is or is a piece of.
/// `vertex_after` are the numbers that vertices have there, or none() of those that are gone. Both
/// meshes are in canonical order.
///
/// Whoever has a vertex that is gone is a piece of what has the ends of its edge instead: nothing
/// goes back more than a generation, so these are there.
template <class I, std::size_t N>
[[nodiscard]] std::vector<std::uint32_t> whole_of(
    const DistributedMesh& mesh, const IndexVector<I, std::array<VertexIndex, N>>& list,
    const AncestorMap& ancestors, const IndexVector<I, std::array<VertexIndex, N>>& coarser_list,
    const AncestorMap& coarser_ancestors,
    const IndexVector<VertexIndex, VertexIndex>& vertex_after) {
    using Entry = std::tuple<std::size_t, std::array<VertexIndex, N>, std::uint32_t>;
    std::vector<Entry> wholes;
    const auto for_each = [](const auto& entities, const AncestorMap& map, auto&& visit) {
        for (std::size_t root = 0; root < map.roots.size(); ++root) {
            for (I i{map.first[root]}; i < I{map.first[root + 1]}; ++i) visit(root, i, entities[i]);
        }
    };
    for_each(coarser_list, coarser_ancestors, [&](std::size_t root, I i, auto vertices) {
        std::ranges::sort(vertices);
        wholes.emplace_back(root, vertices, i.value());
    });
    std::ranges::sort(wholes);

    std::vector<std::uint32_t> found;
    found.reserve(list.size());
    std::vector<VertexIndex> corners;
    for_each(list, ancestors, [&](std::size_t root, I, const auto& vertices) {
        corners.clear();
        for (const VertexIndex v : vertices) {
            if (!vertex_after[v].is_none()) {
                corners.push_back(vertex_after[v]);
                continue;
            }
            const auto& [a, b] = mesh.midpoint_to_edge[v.value() - mesh.input_vertices.size()];
            corners.push_back(vertex_after[a]);
            corners.push_back(vertex_after[b]);
        }
        std::ranges::sort(corners);
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        std::array<VertexIndex, N> whole;
        std::copy_n(corners.begin(), N, whole.begin());
        found.push_back(std::get<2>(*std::ranges::lower_bound(wholes, Entry{root, whole, 0})));
    });
    return found;
}

}  // namespace octetra::distributed
