#pragma once

#include <functional>

#include <octetra/core/selection.hpp>

#include "adapt/mesh_state.hpp"
#include "level/marked_cells.hpp"

namespace octetra::distributed {

/// Collective. Returns the function that marks the cells of a selection, for a step. The function
/// is collective, too, and refers to both arguments. Throws what AdaptiveMesh::marked_cells()
/// throws.
[[nodiscard]] std::function<MarkedCells()> marks_of(const AdaptiveMesh::State& state,
                                                    const Selection& selection);

}  // namespace octetra::distributed
