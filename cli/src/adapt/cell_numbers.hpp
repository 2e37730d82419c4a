#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>

namespace octetra::cli {

/// Collective. Of each cell of this process, the number that a file of the mesh as it is now gives
/// it, from 0. Takes memory in proportion to the part.
[[nodiscard]] std::vector<std::uint64_t> cell_numbers(const distributed::AdaptiveMesh& mesh);

}  // namespace octetra::cli
