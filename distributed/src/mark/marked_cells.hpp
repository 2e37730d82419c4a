#pragma once

#include <vector>

#include <octetra/core/selection.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "pattern/patterns.hpp"

namespace octetra::distributed {

/// This process's cells that a selection marks.
struct MarkedCells {
    bool all = false;  ///< the selection asks for nothing less: they are not listed
    std::vector<CellIndex> cells;
    /// The edges that each of them marks, or empty where the scheme decides.
    std::vector<EdgeMask> edges;
    std::size_t count = 0;
    std::size_t judged = 0;  ///< how many cells were looked at
};

/// `only_new`: this selection has judged all but the new cells of the last level. A cell that it
/// did not mark, and that has not changed, it does not mark now; and those that it marked have.
[[nodiscard]] MarkedCells mark_cells(const DistributedMesh& mesh, const Selection& selection,
                                     bool only_new);

}  // namespace octetra::distributed
