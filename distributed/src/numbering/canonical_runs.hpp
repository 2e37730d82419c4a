#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Where a kind of entity stands in the canonical order: roots in the order of the input, and in
/// their place their descendants.
struct CanonicalRuns {
    /// The number of the first descendant of each of this process's roots.
    std::vector<std::uint64_t> begin;
    std::uint64_t count = 0;  ///< entities of all processes
};

/// Collective. A root is one process's only.
[[nodiscard]] CanonicalRuns canonical_runs(const Communicator& processes,
                                           const AncestorMap& ancestors);

/// Calls emit(number, local number, root) for this process's entities numbered begin .. end-1.
void for_each_between(const CanonicalRuns& runs, const AncestorMap& ancestors, std::uint64_t begin,
                      std::uint64_t end, auto&& emit) {
    // The run that has `begin`, if any has, is the last that does not begin after it.
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

/// The local numbers of this process's entities numbered begin .. end-1: from one up to another.
[[nodiscard]] std::pair<std::size_t, std::size_t> local_range(const CanonicalRuns& runs,
                                                              const AncestorMap& ancestors,
                                                              std::uint64_t begin,
                                                              std::uint64_t end);

}  // namespace octetra::distributed
