#pragma once

#include <vector>

#include <octetra/distributed/predicted_cells.hpp>

#include "script/read_script.hpp"

namespace octetra::cli {

/// Collective among the processes that hold the cells. Estimates the number of cells that each cell
/// becomes by the refinement steps of a script, as far as their criteria determine this without
/// lists of cells; coarsening is ignored. Empty if the numbers are equal for all cells.
[[nodiscard]] std::vector<float> predicted_by_steps(const distributed::CellsToWeigh& cells,
                                                    const Script& script);

}  // namespace octetra::cli
