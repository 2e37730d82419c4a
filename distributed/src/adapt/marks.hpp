#pragma once

#include <cstdint>
#include <span>

#include <octetra/distributed/distributed_mesh.hpp>

#include "mark/marked_cells.hpp"

/// What a program marks, as a level wants it. Each throws InputError where it does not fit the
/// mesh; none is collective.
namespace octetra::distributed {

[[nodiscard]] MarkedCells marked_by_bytes(const DistributedMesh& mesh,
                                          std::span<const std::uint8_t> marks);
[[nodiscard]] MarkedCells marked_by_list(const DistributedMesh& mesh,
                                         std::span<const CellIndex> marked);
/// Cells that have marked edges, so that each edge is marked in one.
[[nodiscard]] MarkedCells cells_with_marked_edges(const DistributedMesh& mesh,
                                                  std::span<const EdgeVertices> marked);

}  // namespace octetra::distributed
