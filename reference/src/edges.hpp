#pragma once

#include <algorithm>
#include <array>
#include <span>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/mesh.hpp>

namespace octetra::reference {

/// The edges of a mesh's cells, numbered in ascending order of (smaller, larger) vertex number,
/// which is also the order of their midpoints.
struct EdgeTable {
    IndexVector<EdgeIndex, EdgeVertices> edges;
    /// For each cell, its six edges in the order of cell_edges.
    IndexVector<CellIndex, std::array<EdgeIndex, 6>> cell_to_edges;
};

[[nodiscard]] EdgeTable number_edges(const Mesh& mesh);

/// Returns the number of the edge between two vertices, which must be an edge of some cell.
[[nodiscard]] EdgeIndex find_edge(const EdgeTable& table, VertexIndex a, VertexIndex b);

[[nodiscard]] inline Segment segment(const Mesh& mesh, const EdgeVertices& edge) {
    return {mesh.points[edge[0]], mesh.points[edge[1]]};
}

/// Returns the longest of the given edges in the strict order of core/edge_order.hpp.
[[nodiscard]] inline EdgeIndex longest(const Mesh& mesh, const EdgeTable& table,
                                       std::span<const EdgeIndex> edges) {
    return *std::ranges::min_element(edges, [&](EdgeIndex e, EdgeIndex f) {
        return longer(segment(mesh, table.edges[e]), segment(mesh, table.edges[f]));
    });
}

/// Returns the three edges of face i of a cell (opposite corner i), given the cell's six edges.
[[nodiscard]] inline std::array<EdgeIndex, 3> face_edges(const std::array<EdgeIndex, 6>& of_cell,
                                                         std::size_t i) {
    // Edge k of a cell joins the corners cell_edges[k]: 01 02 03 12 13 23.
    constexpr std::array<std::array<std::size_t, 3>, 4> edges_of_face{
        {{3, 4, 5}, {1, 2, 5}, {0, 2, 4}, {0, 1, 3}}};
    const auto& [k, l, m] = edges_of_face[i];
    return {of_cell[k], of_cell[l], of_cell[m]};
}

/// A set of edges of the table.
using EdgeSet = IndexVector<EdgeIndex, char>;

}  // namespace octetra::reference
