#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>

namespace octetra::cli {

/// Collective. Returns, for each cell of this process, its number in a file of the current mesh,
/// from 0. Memory is proportional to the part.
[[nodiscard]] std::vector<std::uint64_t> cell_numbers(const distributed::AdaptiveMesh& mesh);

}  // namespace octetra::cli
