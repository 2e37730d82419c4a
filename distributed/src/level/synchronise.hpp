#pragma once

#include <optional>

#include <octetra/distributed/refine.hpp>

#include "comm/local_failure.hpp"
#include "level/closure.hpp"

namespace octetra::distributed {

/// Collective. Closes the marked edges over all processes: in each round every process drains its
/// closure and sends new marks to the ranks that share the edges, until no process has new marks.
/// If a process has failed, there is no result on any process. The closure of a process that failed
/// before the call is not used, and may be null.
[[nodiscard]] std::optional<SynchronisationCounts> synchronise_by_neighbours(
    Closure* closure, const DistributedMesh& mesh, LocalFailure& failure);

/// Collective. The same through the first process (the paper's gateway).
[[nodiscard]] std::optional<SynchronisationCounts> synchronise_by_gateway(
    Closure* closure, const DistributedMesh& mesh, LocalFailure& failure);

}  // namespace octetra::distributed
