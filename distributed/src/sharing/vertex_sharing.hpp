#pragma once

#include <cstdint>
#include <span>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sharing.hpp>

namespace octetra::distributed {

/// Collective. Who has the vertices of a mesh that is still as the input was. A vertex stays on the
/// processes that it is on, whatever is refined; what is added are midpoints of shared edges.
/// `may_be_shared` says of each vertex whether another process has it, if that is known already.
[[nodiscard]] Sharing<VertexIndex> find_vertex_sharing(
    const DistributedMesh& mesh, std::span<const std::uint8_t> may_be_shared = {});

}  // namespace octetra::distributed
