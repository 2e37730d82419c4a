#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Positions of entities of one kind in the canonical order, in which the roots are in input order
/// and each root is replaced by its descendants.
struct CanonicalRuns {
    /// The number of the first descendant of each of this process's roots.
    std::vector<std::uint64_t> begin;
    std::uint64_t count = 0;  ///< number of entities of all processes
};

/// Collective. Every root must be on exactly one process.
[[nodiscard]] CanonicalRuns canonical_runs(const Communicator& processes,
                                           const AncestorMap& ancestors);

/// Calls emit(number, local index, root) for this process's entities numbered begin .. end - 1.
void for_each_between(const CanonicalRuns& runs, const AncestorMap& ancestors, std::uint64_t begin,
                      std::uint64_t end, auto&& emit) {
    // The run that contains `begin`, if any does, is the last one that starts at or before it.
    const auto after = std::ranges::upper_bound(runs.begin, begin);
    auto r = static_cast<std::size_t>(after - runs.begin.begin());
    if (r > 0) --r;
    for (; r < runs.begin.size() && runs.begin[r] < end; ++r) {
        const std::uint64_t length = ancestors.first[r + 1] - ancestors.first[r];
        const std::uint64_t skipped = begin > runs.begin[r] ? begin - runs.begin[r] : 0;
        const std::uint64_t stop = std::min(length, end - runs.begin[r]);
        for (std::uint64_t k = skipped; k < stop; ++k) {
            emit(runs.begin[r] + k, std::size_t{ancestors.first[r]} + k, r);
        }
    }
}

/// Returns the range of local indices of this process's entities numbered begin .. end - 1.
[[nodiscard]] std::pair<std::size_t, std::size_t> local_range(const CanonicalRuns& runs,
                                                              const AncestorMap& ancestors,
                                                              std::uint64_t begin,
                                                              std::uint64_t end);

}  // namespace octetra::distributed
