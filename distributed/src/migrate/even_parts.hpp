#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

struct EvenParts {
    std::vector<int> rank_of_root;
    std::uint64_t most = 0;  ///< what the process that has most has then
};

/// Collective. For each root of this process, of a mesh in canonical order, the process that is to
/// have it so that all have about the same weight: by recursive coordinate bisection, the parts
/// given to processes so that much stays where it is; and where one would have more than so many
/// times the mean, heavy roots move on. `weights` are those of this process's roots.
/// Nothing, on all processes, where the one that has most would not have less, or where a process
/// has failed or fails.
[[nodiscard]] std::optional<EvenParts> even_parts(const DistributedMesh& mesh,
                                                  std::span<const std::uint64_t> weights,
                                                  double most_over_mean, LocalFailure& failure);

/// How many cells each root of this process has become, of a mesh in canonical order.
[[nodiscard]] std::vector<std::uint64_t> cells_of_roots(const DistributedMesh& mesh);

/// Collective. Gives parts, as many as there are processes, to processes: in descending order of
/// what a process has of a part. `weights` are those of what this process has, each of the part
/// that `parts` names. Returns the process of each part, or nothing where one has failed or fails.
[[nodiscard]] std::vector<int> ranks_of_parts(const Communicator& processes,
                                              std::span<const int> parts,
                                              std::span<const std::uint64_t> weights,
                                              LocalFailure& failure);

}  // namespace octetra::distributed
