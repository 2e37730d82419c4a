#pragma once

#include "level/tuning.hpp"

namespace octetra::distributed {

struct LevelOutcome {
    SynchronisationCounts counts;
    bool changed = false;  ///< was any edge of the whole mesh bisected?
    /// Cells of this process that were looked at, once for being judged by the selection and once
    /// for all else.
    std::uint64_t cells_touched = 0;
};

/// Collective. One level of refine(): level number `level`, counted from 1, for messages. From the
/// second on the selection must be that of the level before.
LevelOutcome refine_level(DistributedMesh& mesh, const Selection& selection,
                          const RefineOptions& options, const Tuning& tuning, int level);

}  // namespace octetra::distributed
