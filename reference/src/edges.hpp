#pragma once

#include <array>
#include <vector>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/mesh.hpp>

namespace octetra::reference {

/// The edges of a mesh's cells, numbered in ascending order of (smaller, larger) vertex number:
/// the order in which their midpoints will be numbered.
struct EdgeTable {
    IndexVector<EdgeIndex, EdgeVertices> edges;
    /// For each cell, its six edges in the order of cell_edges.
    IndexVector<CellIndex, std::array<EdgeIndex, 6>> cell_to_edges;
};

[[nodiscard]] EdgeTable number_edges(const Mesh& mesh);

/// The number of the edge between two vertices, which must be an edge of some cell.
[[nodiscard]] EdgeIndex find_edge(const EdgeTable& table, VertexIndex a, VertexIndex b);

[[nodiscard]] inline Segment segment(const Mesh& mesh, const EdgeVertices& edge) {
    return {mesh.points[edge[0]], mesh.points[edge[1]]};
}

/// A set of edges of the table.
using EdgeSet = IndexVector<EdgeIndex, char>;

}  // namespace octetra::reference
