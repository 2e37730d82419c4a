#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/marked_cells.hpp"
#include "level/tuning.hpp"

namespace octetra::distributed {

/// Returns whether the level is expected to change little, because few cells are marked or because
/// they are adjacent to each other. The edges that marked cells mark affect five or six cells for
/// each of their vertices. If `is_last`, the data for incremental levels are not created for this
/// level alone, as that takes longer than a full sweep.
///
/// The measure is vertices, because scattered cells have more of them than adjacent ones; at a
/// sixteenth of the part's vertices both kinds of level take about the same time. A level that
/// marks all cells would execute twice the instructions of a full sweep. Building the adjacency
/// takes a third longer than the first level that uses it would take as a full sweep.
[[nodiscard]] bool suits_incremental_level(const DistributedMesh& mesh, const MarkedCells& marked,
                                           const Tuning& tuning, bool is_last = false);

}  // namespace octetra::distributed
