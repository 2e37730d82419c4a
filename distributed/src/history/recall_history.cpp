#include "history/recall_history.hpp"

#include <algorithm>
#include <stdexcept>

#include "numbering/canonical_runs.hpp"
#include "setup/owners.hpp"

namespace octetra::distributed {
namespace {

struct NumberRange {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
};

/// Returns for each owner of a block of numbers the ranges of this process's numbers in that block.
std::vector<std::vector<NumberRange>> ranges_at_owners(const CanonicalRuns& runs,
                                                       const AncestorMap& ancestors,
                                                       const OwnerMap& owners, int process_count) {
    std::vector<std::vector<NumberRange>> at_owners(static_cast<std::size_t>(process_count));
    for (std::size_t r = 0; r < runs.begin.size(); ++r) {
        std::uint64_t begin = runs.begin[r];
        const std::uint64_t end = begin + ancestors.first[r + 1] - ancestors.first[r];
        while (begin < end) {
            const int rank = owners.rank_of(begin);
            const std::uint64_t stop = std::min(end, owners.end_of(rank));
            auto& ranges = at_owners[static_cast<std::size_t>(rank)];
            if (!ranges.empty() && ranges.back().end == begin) {
                ranges.back().end = stop;
            } else {
                ranges.push_back({begin, stop});
            }
            begin = stop;
        }
    }
    return at_owners;
}

template <class T>
void append(std::vector<T>& list, const std::vector<T>& more) {
    list.insert(list.end(), more.begin(), more.end());
}

void check(bool fits) {
    if (!fits) throw std::logic_error("roots are on another rank than their history");
}

/// Returns the map to the roots of `before` for descendants of its entities, which are the roots of
/// `since`.
AncestorMap composed(const AncestorMap& before, const AncestorMap& since) {
    check(since.roots.size() == before.first.back());
    AncestorMap both = before;
    for (std::uint32_t& first : both.first) first = since.first[first];
    return both;
}

}  // namespace

std::vector<int> ranks_of_roots(const Communicator& processes, const AncestorMap& before,
                                const std::vector<std::uint64_t>& roots) {
    return processes.transaction([&] {
        const CanonicalRuns runs = canonical_runs(processes, before);
        const OwnerMap owners = owners_of_blocks(runs.count, 1, processes.size());
        const std::uint64_t first = owners.begin_of(processes.rank());
        std::vector<int> rank_of(static_cast<std::size_t>(owners.end_of(processes.rank()) - first));
        const auto inboxes =
            processes.all_to_all(ranges_at_owners(runs, before, owners, processes.size()));
        for (std::size_t rank = 0; rank < inboxes.size(); ++rank) {
            for (const NumberRange& range : inboxes[rank]) {
                std::fill(rank_of.data() + (range.begin - first),
                          rank_of.data() + (range.end - first), static_cast<int>(rank));
            }
        }
        return fetch(processes, request(processes, owners, roots), rank_of, first);
    });
}

History joined(const History& before, const DistributedMesh& mesh) {
    check(mesh.input_vertices.size() ==
          before.input_vertices.size() + before.midpoint_to_edge.size());
    History both = before;
    append(both.level_begin, mesh.level_begin);
    append(both.midpoint_to_edge, mesh.midpoint_to_edge);
    append(both.midpoint_markers, mesh.midpoint_markers);
    both.cell_ancestors = composed(before.cell_ancestors, mesh.cell_ancestors);
    both.facet_ancestors = composed(before.facet_ancestors, mesh.facet_ancestors);
    both.edge_ancestors = composed(before.edge_ancestors, mesh.edge_ancestors);
    return both;
}

}  // namespace octetra::distributed
