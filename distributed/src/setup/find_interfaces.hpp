#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Collective. What this process shares with others, found once, when a mesh has been distributed;
/// `mesh` is still as the input was. From level to level it follows from what is bisected.
[[nodiscard]] std::vector<Interface> find_interfaces(const DistributedMesh& mesh);

}  // namespace octetra::distributed
