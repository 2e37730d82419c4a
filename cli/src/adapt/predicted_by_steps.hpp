#pragma once

#include <vector>

#include <octetra/distributed/predicted_cells.hpp>

#include "script/read_script.hpp"

namespace octetra::cli {

/// Collective among the processes that have the cells. About how many cells each cell becomes by
/// the refinements of a script, as far as its criteria tell without lists of cells; what is
/// coarsened again is left out. Empty where all become equally many.
[[nodiscard]] std::vector<float> predicted_by_steps(const distributed::CellsToWeigh& cells,
                                                    const Script& script);

}  // namespace octetra::cli
