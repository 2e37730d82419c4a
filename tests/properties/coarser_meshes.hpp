#pragma once

#include <vector>

#include <octetra/reference/history.hpp>

/// Predicates on a mesh and the coarser mesh that coarsening made of it.
namespace octetra::properties {

/// Returns whether the coarser mesh contains every unmarked cell of the old one, with its region
/// tag.
[[nodiscard]] bool has_unmarked_cells(const Mesh& old, const reference::CellMarks& marked,
                                      const Mesh& coarser);

/// Returns whether each cell of the coarser mesh lies in the parents of the finer cells within it,
/// where the parent is the cell whose bisection made the finer cell. `before` is the replay of the
/// finer history. Corners multiplied by `scale` must be integers of at most 40 bits.
[[nodiscard]] bool coarsens_by_one_generation(const std::vector<reference::Refinement>& before,
                                              const reference::Refinement& coarser, double scale);

}  // namespace octetra::properties
