#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/sharing.hpp>

namespace octetra::distributed {

using FaceIndex = Index<struct FaceRole>;  ///< of a face of a cell, whether it is tagged or not

/// All edges (N = 2) or faces (N = 3) of this process's cells, for who has unknowns there. A
/// picture of the mesh as it was when it was made.
template <class I, std::size_t N, std::size_t PerCell>
struct Sides {
    /// By local number of the vertices, lowest first: ascending.
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

/// A face of a cell on the boundary of the whole mesh.
struct BoundaryFace {
    CellIndex cell;
    std::uint8_t face = 0;  ///< opposite this vertex of the cell

    friend bool operator==(const BoundaryFace&, const BoundaryFace&) = default;
};

}  // namespace octetra::distributed
