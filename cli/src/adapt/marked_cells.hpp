#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/selection.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

namespace octetra::cli {

/// Collective. A byte for each cell of this process: 1 where it is one of these cells of the whole
/// mesh, by the numbers that a file of the mesh as it is now gives them, from 0. The same list on
/// all processes. (A Selection would mean cells of the input.)
[[nodiscard]] std::vector<std::uint8_t> listed_cells(const distributed::AdaptiveMesh& mesh,
                                                     const std::vector<GlobalCell>& cells);

/// Sets the byte of each cell of this process that the criteria mark, but for its list of cells.
void add_marked_cells(const distributed::AdaptiveMesh& mesh, const Selection& selection,
                      std::vector<std::uint8_t>& cell_to_mark);

}  // namespace octetra::cli
