#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/communicator.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

/// A root that a process is to have.
struct PlacedRoot {
    std::uint64_t weight = 0;
    int rank = 0;
};

/// Moves roots from whoever has most to whoever has least, as long as that makes the most less, and
/// more than `goal`: each time the one that leaves these two most alike. Where none does, two take
/// each other's place. `loads` are those of all processes, with more than the roots given.
void relieve(std::vector<std::uint64_t>& loads, std::span<PlacedRoot> roots, std::uint64_t goal);

/// Collective. The same of this process's roots, of which the heavy ones may move, some thousand of
/// all processes: bisection cuts between roots as they lie, and where these are heavy it may miss
/// the middle at each cut. False, on all alike, where a process has failed or fails; else `loads`
/// are what processes have then.
[[nodiscard]] bool relieve_of_heavy_roots(const Communicator& processes,
                                          std::span<const std::uint64_t> weights,
                                          std::span<int> ranks, std::vector<std::uint64_t>& loads,
                                          double most_over_mean, LocalFailure& failure);

}  // namespace octetra::distributed
