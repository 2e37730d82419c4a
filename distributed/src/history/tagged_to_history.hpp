#pragma once

#include <octetra/core/index.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "history/history.hpp"

namespace octetra::distributed {

/// Collective. Tagged facets and edges go, with all that has become of them, to the processes on
/// which they were before they were roots. Their cells must be there already. `numbers` are those
/// of the mesh's vertices; `before` is what this process had. What fails on one process throws
/// alike on all; the mesh is not to be used then.
void bring_tagged_to_history(DistributedMesh& mesh,
                             const IndexVector<VertexIndex, GlobalVertex>& numbers,
                             const History& before);

}  // namespace octetra::distributed
