#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include <octetra/reference/refine.hpp>

#include "edges.hpp"

namespace octetra::reference {

/// For each edge of the table, the vertex number of its midpoint, or none() if the edge is not
/// bisected.
using EdgeToMidpoint = IndexVector<EdgeIndex, VertexIndex>;

/// A marked edge and its midpoint.
struct BisectedEdge {
    EdgeVertices ends;
    VertexIndex midpoint;
};

/// Returns the marked edges of a cell, facet or edge with these vertices, longest first.
[[nodiscard]] std::vector<BisectedEdge> bisected_edges(const Mesh& mesh, const EdgeTable& table,
                                                       const EdgeToMidpoint& midpoints,
                                                       const std::vector<VertexIndex>& vertices);

/// Bisects a cell (N = 4), a facet (3) or an edge (2) by the first listed edge that it contains,
/// then each half recursively, until no piece contains any of these edges; appends the pieces to
/// `children`. `longest_first` must be the result of bisected_edges() for the entity of which
/// `piece` is a part.
template <std::size_t N>
void bisect(const std::array<VertexIndex, N>& piece, const std::vector<BisectedEdge>& longest_first,
            std::vector<std::array<VertexIndex, N>>& children) {
    for (const BisectedEdge& edge : longest_first) {
        const auto a = std::ranges::find(piece, edge.ends[0]);
        const auto b = std::ranges::find(piece, edge.ends[1]);
        if (a == piece.end() || b == piece.end()) continue;

        const auto lower = static_cast<std::size_t>(std::min(a, b) - piece.begin());
        const auto higher = static_cast<std::size_t>(std::max(a, b) - piece.begin());
        std::array<VertexIndex, N> first = piece;  // retains the end at the lower position
        first[higher] = edge.midpoint;
        std::array<VertexIndex, N> second = piece;  // retains the other end
        second[lower] = edge.midpoint;
        bisect(first, longest_first, children);
        bisect(second, longest_first, children);
        return;
    }
    children.push_back(piece);
}

/// Returns the pieces into which an entity of the mesh is bisected, in order.
template <std::size_t N>
[[nodiscard]] std::vector<std::array<VertexIndex, N>> pieces_of(
    const std::array<VertexIndex, N>& entity, const Mesh& mesh, const EdgeTable& table,
    const EdgeToMidpoint& midpoints) {
    std::vector<std::array<VertexIndex, N>> pieces;
    bisect(entity, bisected_edges(mesh, table, midpoints, {entity.begin(), entity.end()}), pieces);
    return pieces;
}

/// Assigns consecutive vertex numbers to the midpoints of the given edges of the mesh, which are in
/// ascending order.
[[nodiscard]] EdgeToMidpoint midpoints_of(const std::vector<EdgeVertices>& edges,
                                          const EdgeTable& table, const Mesh& mesh);

/// Bisects these edges, a closed set in ascending order, and accordingly the cells, facets and
/// tagged edges of the mesh. Throws as refine() does; `level` is used in the message.
[[nodiscard]] Refinement bisect_mesh(const Refinement& coarse,
                                     const std::vector<EdgeVertices>& edges, int level,
                                     std::size_t max_cells = unlimited);

/// Returns the mesh with the identity maps.
[[nodiscard]] Refinement unrefined(const Mesh& mesh);

}  // namespace octetra::reference
