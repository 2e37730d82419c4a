#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/selection.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "adapt/size_files.hpp"

namespace octetra::cli {

/// Collective. Returns a byte for each cell of this process: 1 for the listed cells of the whole
/// mesh, which are numbered from 0 as in a file of the current mesh. All processes pass the same
/// list. (Selection::cells would refer to cells of the input instead.)
[[nodiscard]] std::vector<std::uint8_t> listed_cells(const distributed::AdaptiveMesh& mesh,
                                                     const std::vector<GlobalCell>& cells);

/// Collective. Sets the byte of each cell of this process that the criteria, except for the list of
/// cells, mark. Expressions may use the fields.
void add_marked_cells(const distributed::AdaptiveMesh& mesh, const Selection& selection,
                      const CarriedFields& fields, std::vector<std::uint8_t>& cell_to_mark);

}  // namespace octetra::cli
