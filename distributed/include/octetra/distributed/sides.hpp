#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/sharing.hpp>

namespace octetra::distributed {

using FaceIndex = Index<struct FaceRole>;  ///< a face of a cell, tagged or not

/// The corners of the four faces of a cell, face i opposite corner i, in an order whose normal by
/// the right-hand rule points out of the (positively oriented) cell. cell_faces has the same
/// corners in ascending order, whose normals point out of the cell for faces 0 and 2 and into it
/// for faces 1 and 3.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> outward_faces{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Returns the vertices of face `face` of a cell; the normal by the right-hand rule points out of
/// the cell.
[[nodiscard]] inline FacetVertices outward_face(const CellVertices& cell, std::size_t face) {
    const auto& [i, j, k] = outward_faces[face];
    return {cell[i], cell[j], cell[k]};
}

/// Returns whether the normal of face `face`, with its vertices in ascending order as in MeshFaces,
/// points out of this cell. It points into the cell on the other side.
[[nodiscard]] inline bool points_outward(const CellVertices& cell, std::size_t face) {
    const auto& [a, b, c] = outward_face(cell, face);
    return (a < b ? 1 : 0) + (b < c ? 1 : 0) + (c < a ? 1 : 0) == 2;
}

/// All edges (N = 2) or faces (N = 3) of this process's cells, for programs with unknowns on them.
/// A snapshot of the mesh at the time of its creation.
///
/// The vertices of an edge or a face are in ascending order both of their local and of their global
/// numbers. So all processes see an edge in the same direction, and a face with the same normal by
/// the right-hand rule, on the boundary and inside; points_outward() relates the normal to a cell.
template <class I, std::size_t N, std::size_t PerCell>
struct Sides {
    /// Vertices of each side, in ascending order; the list is ascending.
    IndexVector<I, std::array<VertexIndex, N>> vertices;
    /// Sides of each cell, in the order of cell_edges or cell_faces.
    IndexVector<CellIndex, std::array<I, PerCell>> of_cell;
    /// Global numbers, in the lexicographic order of the sides' global vertex numbers: the same for
    /// any number of processes.
    IndexVector<I, std::uint64_t> numbers;
    std::uint64_t count = 0;  ///< in the whole mesh
    Sharing<I> sharing;
};

using MeshEdges = Sides<EdgeIndex, 2, 6>;
using MeshFaces = Sides<FaceIndex, 3, 4>;

/// The cell on the other side of a face of a cell.
struct FaceNeighbour {
    static constexpr int no_rank = -1;
    int rank = no_rank;  ///< the rank that has the cell, or no_rank if the face is on the boundary
    CellIndex cell;      ///< its local number on that rank

    [[nodiscard]] bool is_boundary() const { return rank == no_rank; }
    friend bool operator==(const FaceNeighbour&, const FaceNeighbour&) = default;
};

/// The neighbours of each cell of this process through its four faces: face i lies opposite vertex
/// i.
using FaceNeighbours = IndexVector<CellIndex, std::array<FaceNeighbour, 4>>;

/// A face of a cell on the boundary of the whole mesh; outward_face() returns its vertices.
struct BoundaryFace {
    CellIndex cell;
    std::uint8_t face = 0;  ///< the face opposite this vertex of the cell

    friend bool operator==(const BoundaryFace&, const BoundaryFace&) = default;
};

}  // namespace octetra::distributed
