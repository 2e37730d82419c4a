#pragma once

#include <octetra/distributed/refine.hpp>

#include "level/marked_edges.hpp"

namespace octetra::distributed {

/// Collective. Closes the marked edges over all processes: in each round every process drains its
/// closure and sends new marks to the ranks that share the edges, until no process has new marks.
/// In a round, each pair of neighbours exchanges one message, possibly empty, so every process
/// knows how many messages to expect. Marks are not forwarded: the process that marks an edge sends
/// it to all processes that share the edge.
[[nodiscard]] SynchronisationCounts synchronise_by_neighbours(MarkedEdges& closure,
                                                              const DistributedMesh& mesh);

/// Collective. The same through the first process (the paper's gateway).
[[nodiscard]] SynchronisationCounts synchronise_by_gateway(MarkedEdges& closure,
                                                           const DistributedMesh& mesh);

}  // namespace octetra::distributed
