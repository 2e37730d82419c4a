#pragma once

#include <octetra/core/index.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "history/history.hpp"

namespace octetra::distributed {

/// Collective. Moves tagged facets and edges, with all their descendants, to the processes that had
/// them before they became roots. Their cells must be there already. `numbers` are the global
/// numbers of the mesh's vertices; `before` is this process's history from that time. A failure of
/// one process is thrown on all; the mesh must not be used afterwards.
void move_tagged_to_history(DistributedMesh& mesh,
                            const IndexVector<VertexIndex, GlobalVertex>& numbers,
                            const History& before);

}  // namespace octetra::distributed
