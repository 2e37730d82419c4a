#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "files/gmsh/sections_2.hpp"

namespace octetra::gmsh {

/// In version 2, an element is listed once for each of its groups. It may be listed by the last
/// rows of one process and again by the first rows of another, which keeps it at first. `runs`:
/// those of each process. Returns the number of elements to be removed from the front of the list
/// of `rank`; nothing if the runs do not determine it on all processes.
template <std::size_t N>
[[nodiscard]] std::optional<std::uint64_t> count_listed_again(std::span<const ListedRun<N>> runs,
                                                              std::size_t rank) {
    std::uint64_t removed_count = 0;
    ListedElement<N> last;  // the last element kept so far
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const ListedRun<N>& run = runs[r];
        if (run.kept == 0) continue;
        const bool is_again =
            run.first.physical != last.physical && is_same_element(run.first, last);
        if (!is_again) {
            last = run.last;
            continue;
        }
        const std::size_t known = std::min<std::uint64_t>(run.others, run.groups_of_others.size());
        const auto groups = std::span(run.groups_of_others).first(known);
        if (known < run.others || std::ranges::find(groups, last.physical) != groups.end()) {
            return std::nullopt;
        }
        if (r == rank) removed_count = run.equal_to_first;
        if (run.equal_to_first < run.kept) last = run.last;
    }
    return removed_count;
}

}  // namespace octetra::gmsh
