#pragma once

#include <functional>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/partition.hpp>

namespace octetra::cli {

/// Collective. The parts of a mesh that the first process has. `weights`, called there alone if the
/// partition takes any, are what its cells weigh.
[[nodiscard]] distributed::DistributedMesh share_out(
    Mesh mesh, const distributed::Partition& partition, const distributed::Communicator& world,
    const std::function<std::vector<float>(const Mesh&)>& weights);

}  // namespace octetra::cli
