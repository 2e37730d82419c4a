#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/tuning.hpp"
#include "mark/marked_cells.hpp"

namespace octetra::distributed {

/// Would little change, because few cells are marked or they are all in one place? Edges
/// that marked cells mark concern five or six cells for each of their vertices. `is_last`: what an
/// incremental level goes by is not made for this one alone, as that takes longer than a full
/// sweep.
[[nodiscard]] bool suits_incremental_level(const DistributedMesh& mesh, const MarkedCells& marked,
                                           const Tuning& tuning, bool is_last = false);

}  // namespace octetra::distributed
