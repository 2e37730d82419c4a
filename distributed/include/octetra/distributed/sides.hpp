#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/sharing.hpp>

namespace octetra::distributed {

using FaceIndex = Index<struct FaceRole>;  ///< of a face of a cell, whether it is tagged or not

/// Corners of the four faces of a cell, face i opposite corner i, in an order for which the normal
/// by the right-hand rule points out of the (positively oriented) cell. cell_faces has the same
/// corners in ascending order, whose normals point out of the cell for faces 0 and 2 and into it
/// for faces 1 and 3.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> outward_faces{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// The vertices of face `face` of a cell; the normal by the right-hand rule points out of the cell.
[[nodiscard]] inline FacetVertices outward_face(const CellVertices& cell, std::size_t face) {
    const auto& [i, j, k] = outward_faces[face];
    return {cell[i], cell[j], cell[k]};
}

/// Does the normal of face `face`, with its vertices in ascending order as MeshFaces has them,
/// point out of this cell? It points into the cell on the other side.
[[nodiscard]] inline bool points_outward(const CellVertices& cell, std::size_t face) {
    const auto& [a, b, c] = outward_face(cell, face);
    return (a < b ? 1 : 0) + (b < c ? 1 : 0) + (c < a ? 1 : 0) == 2;
}

/// All edges (N = 2) or faces (N = 3) of this process's cells, for who has unknowns there. A
/// picture of the mesh as it was when it was made.
///
/// The vertices of an edge or a face stand in ascending order, of their local numbers and likewise
/// of their numbers in the whole mesh. So all processes see an edge in the same direction, and a
/// face with the same normal by the right-hand rule, on the boundary and inside; points_outward()
/// relates the normal to a cell.
template <class I, std::size_t N, std::size_t PerCell>
struct Sides {
    /// Each lowest first; the list ascends.
    IndexVector<I, std::array<VertexIndex, N>> vertices;
    /// Those of each cell, in the order of cell_edges or cell_faces.
    IndexVector<CellIndex, std::array<I, PerCell>> of_cell;
    /// Their numbers in the whole mesh, in the order of their vertices' numbers there: the same on
    /// any number of processes.
    IndexVector<I, std::uint64_t> numbers;
    std::uint64_t count = 0;  ///< in the whole mesh
    Sharing<I> sharing;
};

using MeshEdges = Sides<EdgeIndex, 2, 6>;
using MeshFaces = Sides<FaceIndex, 3, 4>;

/// What is on the other side of a face of a cell.
struct FaceNeighbour {
    static constexpr int nobody = -1;
    int rank = nobody;  ///< the process that has the cell; nobody: the face is on the boundary
    CellIndex cell;     ///< by its number on that process

    [[nodiscard]] bool is_boundary() const { return rank == nobody; }
    friend bool operator==(const FaceNeighbour&, const FaceNeighbour&) = default;
};

/// Of each cell, what is behind its four faces: face i lies opposite vertex i.
using FaceNeighbours = IndexVector<CellIndex, std::array<FaceNeighbour, 4>>;

/// A face of a cell on the boundary of the whole mesh; outward_face() has its vertices.
struct BoundaryFace {
    CellIndex cell;
    std::uint8_t face = 0;  ///< opposite this vertex of the cell

    friend bool operator==(const BoundaryFace&, const BoundaryFace&) = default;
};

}  // namespace octetra::distributed
