#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sharing.hpp>

namespace octetra::distributed {

/// Collective. The edges and faces that this process shares with others, found when a mesh has been
/// distributed or has moved; `mesh` is still as the input was. From level to level they follow from
/// what is bisected. `sharing` is that of its vertices: whoever has all vertices of an edge or face
/// may have it, and is asked; one message to each.
[[nodiscard]] std::vector<Interface> find_interfaces(const DistributedMesh& mesh,
                                                     const Sharing<VertexIndex>& sharing);

}  // namespace octetra::distributed
