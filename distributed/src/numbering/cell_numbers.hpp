#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Collective. Returns the number of each cell of this process in the canonical order of the whole
/// mesh. A failure of one process is thrown on all.
[[nodiscard]] std::vector<std::uint64_t> cell_numbers(const DistributedMesh& mesh);

}  // namespace octetra::distributed
