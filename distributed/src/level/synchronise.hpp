#pragma once

#include <octetra/distributed/refine.hpp>

#include "level/closure.hpp"

namespace octetra::distributed {

/// Collective. Closes the selection on all processes: each one drains, tells those that share the
/// edges it marked, and so on until no process has anything to tell.
SynchronisationCounts synchronise_by_neighbours(Closure& closure, const DistributedMesh& mesh);

/// Collective. The same by way of the first process (the paper's gateway).
SynchronisationCounts synchronise_by_gateway(Closure& closure, const DistributedMesh& mesh);

}  // namespace octetra::distributed
