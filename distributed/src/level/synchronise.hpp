#pragma once

#include <optional>

#include <octetra/distributed/refine.hpp>

#include "comm/local_failure.hpp"
#include "level/closure.hpp"

namespace octetra::distributed {

/// Collective. Closes the selection on all processes: each one drains, tells those that share the
/// edges it marked, and so on until no process has anything to tell, or one has failed: then, on
/// all processes, there is no result. The closure of a process that has failed before is not looked
/// at, and may be null.
[[nodiscard]] std::optional<SynchronisationCounts> synchronise_by_neighbours(
    Closure* closure, const DistributedMesh& mesh, LocalFailure& failure);

/// Collective. The same by way of the first process (the paper's gateway).
[[nodiscard]] std::optional<SynchronisationCounts> synchronise_by_gateway(
    Closure* closure, const DistributedMesh& mesh, LocalFailure& failure);

}  // namespace octetra::distributed
