#pragma once

#include <octetra/distributed/refine.hpp>

namespace octetra::distributed {

struct LevelOutcome {
    SynchronisationCounts counts;
    bool changed = false;  ///< was any edge of the whole mesh bisected?
};

/// Collective. One level of refine(): level number `level`, counted from 1, for messages.
LevelOutcome refine_level(DistributedMesh& mesh, const Selection& selection,
                          const RefineOptions& options, int level);

}  // namespace octetra::distributed
