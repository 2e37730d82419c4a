#pragma once

#include <vector>

#include <octetra/reference/history.hpp>

/// A mesh, and a coarser one that coarsening has made of it.
namespace octetra::properties {

/// Has the coarser mesh every cell of the old one that was not marked, with its region tag?
[[nodiscard]] bool has_unmarked_cells(const Mesh& old, const reference::CellMarks& marked,
                                      const Mesh& coarser);

/// Does each cell of the coarser mesh lie in those that its pieces were made of when they were
/// made? `before` is the replay of the finer one. Corners times `scale` must be integers of at most
/// 40 bits.
[[nodiscard]] bool goes_back_by_one_generation(const std::vector<reference::Refinement>& before,
                                               const reference::Refinement& coarser, double scale);

}  // namespace octetra::properties
