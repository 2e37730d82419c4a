#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <octetra/core/error.hpp>

/// Repeated elements of version 2, in which an element of an entity in several groups is listed
/// once for each of them.
namespace octetra::gmsh {

/// The part of a kept element needed to recognise a repetition of it.
template <std::size_t N>
struct ListedElement {
    std::array<std::uint64_t, N> nodes{};
    std::int32_t physical = 0;
    std::int32_t elementary = 0;
    bool is_there = false;
};

/// Returns whether both are the same element of the same entity. The order of the vertices is
/// reversed if a group contains the entity reversed.
template <std::size_t N>
bool is_same_element(const ListedElement<N>& a, const ListedElement<N>& b) {
    if (!a.is_there || !b.is_there || a.elementary != b.elementary) return false;
    auto nodes = a.nodes;
    auto other_nodes = b.nodes;
    std::ranges::sort(nodes);
    std::ranges::sort(other_nodes);
    return nodes == other_nodes;
}

/// Summary of consecutive elements of a kind, from which repetitions before or after them can be
/// recognised.
template <std::size_t N>
struct ListedRun {
    ListedElement<N> first;            ///< first element kept
    ListedElement<N> last;             ///< last element kept
    std::uint64_t kept = 0;            ///< number of elements kept
    std::uint64_t equal_to_first = 0;  ///< kept elements at the beginning that equal the first
    std::uint64_t others = 0;          ///< repetitions of it in other groups, which are ignored
    std::array<std::int32_t, 6> groups_of_others{};  ///< the first of these groups

    /// The caller must set the nodes of `last` before they are read.
    void keep(const std::array<std::uint64_t, N>& nodes, std::int32_t physical,
              std::int32_t elementary) {
        last.physical = physical;
        last.elementary = elementary;
        last.is_there = true;
        if (kept == equal_to_first) {
            const ListedElement<N> one{nodes, physical, elementary, true};
            if (kept == 0) first = one;
            if (is_same_element(one, first)) ++equal_to_first;
        }
        ++kept;
    }
    void count_repetition(std::int32_t group) {
        if (kept != equal_to_first) return;
        if (others < groups_of_others.size()) groups_of_others[others] = group;
        ++others;
    }
};

/// In version 2, an element is listed once for each of its groups. It may be listed by the last
/// rows of one process and again by the first rows of another, which keeps it at first. `runs`:
/// those of each process. Returns the number of elements to be removed from the front of the list
/// of `rank`. Throws if the runs do not determine it on all processes.
template <std::size_t N>
[[nodiscard]] std::uint64_t count_listed_again(std::span<const ListedRun<N>> runs,
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
            throw InputError("elements of too many groups");
        }
        if (r == rank) removed_count = run.equal_to_first;
        if (run.equal_to_first < run.kept) last = run.last;
    }
    return removed_count;
}

}  // namespace octetra::gmsh
