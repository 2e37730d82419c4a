#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// A root and the process that it is assigned to.
struct AssignedRoot {
    std::uint64_t weight = 0;
    int rank = 0;
};

/// Moves roots from the process with the greatest load to the one with the smallest, as long as the
/// greatest load exceeds `goal` and decreases. Each time it selects the root that minimises the
/// difference between the two; if there is none, it swaps two roots. `loads` are those of all
/// processes, including roots that are not passed.
void balance_loads(std::vector<std::uint64_t>& loads, std::span<AssignedRoot> roots,
                   std::uint64_t goal);

/// Collective. Applies balance_loads() to the heavy roots of all processes, at most a few thousand.
/// Bisection separates roots by position, so heavy ones may cause an imbalance in each cut. `loads`
/// become the loads after the moves.
void balance_heavy_roots(const Communicator& processes, std::span<const std::uint64_t> weights,
                         std::span<int> ranks, std::vector<std::uint64_t>& loads,
                         double most_over_mean);

}  // namespace octetra::distributed
