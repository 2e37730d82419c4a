#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include <octetra/reference/refine.hpp>

#include "edges.hpp"

namespace octetra::reference {

/// For each edge of the table its midpoint's vertex number, or none() if it is not bisected.
using EdgeToMidpoint = IndexVector<EdgeIndex, VertexIndex>;

/// A marked edge and its midpoint.
struct BisectedEdge {
    EdgeVertices ends;
    VertexIndex midpoint;
};

/// The marked ones among the edges of a cell, facet or edge with these vertices, longest first.
[[nodiscard]] std::vector<BisectedEdge> bisected_edges(const Mesh& mesh, const EdgeTable& table,
                                                       const EdgeToMidpoint& midpoints,
                                                       const std::vector<VertexIndex>& vertices);

/// Bisects a cell (N = 4), a facet (3) or an edge (2) by the first of the edges that it has, then
/// each half likewise, until no piece has any of them left; appends the pieces to `children`.
/// `longest_first` must come from bisected_edges() of the entity that the piece is of.
template <std::size_t N>
void bisect(const std::array<VertexIndex, N>& piece, const std::vector<BisectedEdge>& longest_first,
            std::vector<std::array<VertexIndex, N>>& children) {
    for (const BisectedEdge& edge : longest_first) {
        const auto a = std::ranges::find(piece, edge.ends[0]);
        const auto b = std::ranges::find(piece, edge.ends[1]);
        if (a == piece.end() || b == piece.end()) continue;

        const auto lower = static_cast<std::size_t>(std::min(a, b) - piece.begin());
        const auto higher = static_cast<std::size_t>(std::max(a, b) - piece.begin());
        std::array<VertexIndex, N> first = piece;  // keeps the end at the lower position
        first[higher] = edge.midpoint;
        std::array<VertexIndex, N> second = piece;  // keeps the other
        second[lower] = edge.midpoint;
        bisect(first, longest_first, children);
        bisect(second, longest_first, children);
        return;
    }
    children.push_back(piece);
}

/// All of that for an entity of the mesh: the pieces that it is bisected into, in order.
template <std::size_t N>
[[nodiscard]] std::vector<std::array<VertexIndex, N>> pieces_of(
    const std::array<VertexIndex, N>& entity, const Mesh& mesh, const EdgeTable& table,
    const EdgeToMidpoint& midpoints) {
    std::vector<std::array<VertexIndex, N>> pieces;
    bisect(entity, bisected_edges(mesh, table, midpoints, {entity.begin(), entity.end()}), pieces);
    return pieces;
}

/// The numbers of the midpoints of some of the mesh's edges, which ascend.
[[nodiscard]] EdgeToMidpoint midpoints_of(const std::vector<EdgeVertices>& edges,
                                          const EdgeTable& table, const Mesh& mesh);

/// The mesh with these edges bisected, a closed set that ascends, and by them its cells, facets and
/// tagged edges. Throws as refine() does; `level` is for the message.
[[nodiscard]] Refinement bisect_mesh(const Refinement& coarse,
                                     const std::vector<EdgeVertices>& edges, int level,
                                     std::size_t max_cells = any_number);

/// The mesh as it is.
[[nodiscard]] Refinement unrefined(const Mesh& mesh);

}  // namespace octetra::reference
