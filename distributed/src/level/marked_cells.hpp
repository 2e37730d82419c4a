#pragma once

#include <vector>

#include <octetra/core/selection.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "pattern/patterns.hpp"

namespace octetra::distributed {

/// The cells of this process that a selection marks.
struct MarkedCells {
    bool all = false;  ///< all cells are marked, and not listed
    std::vector<CellIndex> cells;
    /// The edges that each listed cell marks; empty if the scheme determines them.
    std::vector<EdgeMask> edges;
    std::size_t count = 0;
    std::size_t tested = 0;  ///< number of cells that were tested
};

/// Returns the cells of this process that a selection marks. `only_new`: the same selection was
/// applied before the last level, so that only the new cells of that level are tested. An unchanged
/// cell that was not marked then is not marked now; and the marked ones were bisected.
[[nodiscard]] MarkedCells mark_cells(const DistributedMesh& mesh, const Selection& selection,
                                     bool only_new);

}  // namespace octetra::distributed
