#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/tuning.hpp"
#include "mark/marked_cells.hpp"

namespace octetra::distributed {

/// Returns whether the level is expected to change little, because few cells are marked or because
/// they are adjacent to each other. The edges that marked cells mark affect five or six cells for
/// each of their vertices. If `is_last`, the data for incremental levels are not created for this
/// level alone, as that takes longer than a full sweep.
[[nodiscard]] bool suits_incremental_level(const DistributedMesh& mesh, const MarkedCells& marked,
                                           const Tuning& tuning, bool is_last = false);

}  // namespace octetra::distributed
