#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Collective. The number of each cell of this process in the canonical order of the whole mesh.
/// Throws alike on all processes.
[[nodiscard]] std::vector<std::uint64_t> cell_numbers(const DistributedMesh& mesh);

}  // namespace octetra::distributed
