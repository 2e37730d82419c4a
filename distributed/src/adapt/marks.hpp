#pragma once

#include <cstdint>
#include <span>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/marked_cells.hpp"

/// Conversions of the marks of a program to those of a level. Each throws InputError if the marks
/// do not fit the mesh; none is collective.
namespace octetra::distributed {

[[nodiscard]] MarkedCells marked_by_bytes(const DistributedMesh& mesh,
                                          std::span<const std::uint8_t> marks);
[[nodiscard]] MarkedCells marked_by_list(const DistributedMesh& mesh,
                                         std::span<const CellIndex> marked);
/// Returns cells with marked edges, such that each edge is marked in one cell.
[[nodiscard]] MarkedCells cells_with_marked_edges(const DistributedMesh& mesh,
                                                  std::span<const EdgeVertices> marked);

}  // namespace octetra::distributed
