#pragma once

#include <cstdint>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sharing.hpp>

#include "comm/local_failure.hpp"
#include "level/incremental/adjacency.hpp"
#include "mark/marked_cells.hpp"

namespace octetra::distributed {

/// For each vertex of a process: 1 if it stays, else 0.
using KeptVertices = IndexVector<VertexIndex, std::uint8_t>;

/// Collective. The vertices that stay when the marked cells go back by one generation: (a) those of
/// the input, of a present cell that is not marked, or of a cell that some step cut; and (b) with
/// the midpoint of an edge, for every face which had that edge when it was bisected, the midpoint
/// of the face's longest edge.
///
/// All of it is seen in the present mesh. A cell that was cut at a corner has a descendant there,
/// with vertices that are newer than the corner. And where two edges of a face were bisected, the
/// midpoint of its longest edge is joined to the other's, for as long as one of them may go.
///
/// Nothing depends on the order of cells, nor on the partition. With the mesh's adjacency, which
/// may be null, a process looks at the marked cells and those around them, else at its whole part.
/// The adjacency is afterwards as it was.
/// Where a process has failed or fails, the result is not to be used on any.
[[nodiscard]] KeptVertices find_kept_vertices(const DistributedMesh& mesh,
                                              const Sharing<VertexIndex>& sharing,
                                              const MarkedCells& marked, Adjacency* adjacency,
                                              LocalFailure& failure);

}  // namespace octetra::distributed
