#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Collective. What this process shares with others, found once, when a mesh has been distributed;
/// `mesh` is still as the input was. From level to level it follows from what is bisected.
/// `may_be_shared` says of each vertex whether another process has it, if that is known already.
[[nodiscard]] std::vector<Interface> find_interfaces(
    const DistributedMesh& mesh, std::span<const std::uint8_t> may_be_shared = {});

}  // namespace octetra::distributed
