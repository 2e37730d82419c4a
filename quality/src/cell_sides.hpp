#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::quality {

/// Visits every edge (sides = cell_edges) or face (sides = cell_faces) of the cells once, in
/// ascending order: calls visit(vertices, cells) with the vertices, ascending, and the number of
/// cells that contain the side.
///
/// The sides of all cells are placed in buckets by smallest vertex, which store only the other
/// vertices, and each bucket is sorted. Temporary memory: 8 bytes per vertex and 24 (edges) or 32
/// (faces) per cell.
template <std::size_t N, std::size_t Sides>
void for_each_side(const Mesh& mesh, const std::array<std::array<std::uint8_t, N>, Sides>& sides,
                   auto&& visit) {
    using Vertices = std::array<VertexIndex, N>;
    using Rest = std::array<VertexIndex, N - 1>;

    const auto for_each_occurrence = [&](auto&& found) {
        for (const CellVertices& cell : mesh.cells) {
            for (const auto& side : sides) {
                Vertices vertices;
                for (std::size_t k = 0; k < N; ++k) vertices[k] = cell[side[k]];
                std::ranges::sort(vertices);
                found(vertices);
            }
        }
    };

    std::vector<std::size_t> bucket_end(mesh.points.size(), 0);
    for_each_occurrence([&](const Vertices& v) { ++bucket_end[v[0].value()]; });
    std::exclusive_scan(bucket_end.begin(), bucket_end.end(), bucket_end.begin(), std::size_t{0});
    // bucket_end now contains the beginning of each bucket; filling the buckets advances it to the
    // end.
    std::vector<Rest> rests(Sides * mesh.cells.size());
    for_each_occurrence([&](const Vertices& v) {
        Rest& rest = rests[bucket_end[v[0].value()]++];
        std::copy(v.begin() + 1, v.end(), rest.begin());
    });

    auto first = rests.begin();
    for (VertexIndex smallest{0}; smallest < mesh.points.end_index(); ++smallest) {
        const auto end = rests.begin() + static_cast<std::ptrdiff_t>(bucket_end[smallest.value()]);
        std::sort(first, end);
        while (first != end) {
            const auto next = std::find_if(first, end, [&](const Rest& r) { return r != *first; });
            Vertices vertices{smallest};
            std::copy(first->begin(), first->end(), vertices.begin() + 1);
            visit(vertices, static_cast<std::size_t>(next - first));
            first = next;
        }
    }
}

}  // namespace octetra::quality
