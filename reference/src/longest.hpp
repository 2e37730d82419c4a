#pragma once

#include <span>

#include "edges.hpp"

namespace octetra::reference {

/// The longest of some edges, in the strict order of core/edge_order.hpp.
[[nodiscard]] inline EdgeIndex longest(const Mesh& mesh, const EdgeTable& table,
                                       std::span<const EdgeIndex> edges) {
    EdgeIndex best = edges.front();
    for (const EdgeIndex e : edges) {
        if (longer(segment(mesh, table.edges[e]), segment(mesh, table.edges[best]))) best = e;
    }
    return best;
}

/// The three edges of face i of a cell (the one opposite corner i), from the cell's six.
[[nodiscard]] inline std::array<EdgeIndex, 3> face_edges(const std::array<EdgeIndex, 6>& of_cell,
                                                         std::size_t i) {
    // Edge k of a cell joins the corners cell_edges[k]: 01 02 03 12 13 23.
    constexpr std::array<std::array<std::size_t, 3>, 4> edges_of_face{
        {{3, 4, 5}, {1, 2, 5}, {0, 2, 4}, {0, 1, 3}}};
    const auto& [k, l, m] = edges_of_face[i];
    return {of_cell[k], of_cell[l], of_cell[m]};
}

}  // namespace octetra::reference
