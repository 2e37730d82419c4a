#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sharing.hpp>

namespace octetra::distributed {

/// Collective. Returns the edges and faces that this process shares with others, after a mesh
/// without levels was distributed or migrated; levels derive the new interfaces from the old ones.
/// `sharing` is that of its vertices: a process that has all vertices of an edge or face may have
/// it, and is asked in one message.
[[nodiscard]] std::vector<Interface> find_interfaces(const DistributedMesh& mesh,
                                                     const Sharing<VertexIndex>& sharing);

}  // namespace octetra::distributed
