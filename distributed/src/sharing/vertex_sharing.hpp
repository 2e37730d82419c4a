#pragma once

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sharing.hpp>

namespace octetra::distributed {

/// Collective. Who has the vertices of a mesh that is still as the input was. A vertex stays on the
/// processes that it is on, whatever is refined; what is added are midpoints of shared edges.
[[nodiscard]] Sharing<VertexIndex> find_vertex_sharing(const DistributedMesh& mesh);

}  // namespace octetra::distributed
