#pragma once

#include <cstdint>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sharing.hpp>

#include "level/incremental/adjacency.hpp"
#include "level/marked_cells.hpp"

namespace octetra::distributed {

/// For each vertex of a process: 1 if it is kept, else 0.
using KeptVertices = IndexVector<VertexIndex, std::uint8_t>;

/// Collective. Determines the vertices that are kept when the marked cells are coarsened by one
/// generation: (a) the vertices of the input, of a current cell that is not marked, and of any cell
/// that a step bisected; and (b) for each kept midpoint of an edge and each face that had this edge
/// when it was bisected, the midpoint of the face's longest edge; and (c), with Closure::regular,
/// all midpoints of the edges of a cell if a midpoint of an edge of one of its children is kept.
///
/// The current mesh is sufficient to decide this. A cell that was bisected has a descendant at each
/// of its corners, with vertices that are newer than the corner. And if two edges of a face were
/// bisected, the midpoint of its longest edge is joined to that of the other, as long as either may
/// be removed.
///
/// The result does not depend on the order of cells or on the partition. With the mesh's Adjacency,
/// which may be null, a process tests the marked cells and those around them, otherwise its whole
/// part. The Adjacency is unchanged on return.
[[nodiscard]] KeptVertices find_kept_vertices(const DistributedMesh& mesh,
                                              const Sharing<VertexIndex>& sharing,
                                              const MarkedCells& marked, Adjacency* adjacency);

}  // namespace octetra::distributed
