#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

struct EvenParts {
    std::vector<int> rank_of_root;
    std::uint64_t most = 0;  ///< the greatest load of a process after the move
};

/// Collective. Returns for each root of this process, of a mesh in canonical order, the process
/// that is to have it so that loads are nearly equal. Parts are computed by recursive coordinate
/// bisection and assigned to processes so that little moves. If the greatest load exceeds
/// `most_over_mean` times the mean, heavy roots are reassigned. `weights` are those of this
/// process's roots. Returns nothing on all processes if the greatest load would not decrease.
[[nodiscard]] std::optional<EvenParts> even_parts(const DistributedMesh& mesh,
                                                  std::span<const std::uint64_t> weights,
                                                  double most_over_mean);

/// Returns the number of cells in each root of this process, of a mesh in canonical order.
[[nodiscard]] std::vector<std::uint64_t> cells_of_roots(const DistributedMesh& mesh);

/// Collective. Assigns parts, one to each process, in descending order of the weight of the part
/// that the process has. Element i on this process belongs to part parts[i] and has weight
/// weights[i]. Returns the process of each part.
[[nodiscard]] std::vector<int> ranks_of_parts(const Communicator& processes,
                                              std::span<const int> parts,
                                              std::span<const std::uint64_t> weights);

}  // namespace octetra::distributed
