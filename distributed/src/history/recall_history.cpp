#include "comm/local_failure.hpp"
#include "history/recall_history.hpp"

#include <algorithm>
#include <stdexcept>

#include "numbering/canonical_runs.hpp"
#include "setup/homes.hpp"

namespace octetra::distributed {
namespace {

struct Stretch {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
};

/// Returns for each owner of a block of numbers the ranges of this process's numbers in that block.
std::vector<std::vector<Stretch>> stretches_at_homes(const CanonicalRuns& runs,
                                                     const AncestorMap& ancestors,
                                                     const Homes& homes, int process_count) {
    std::vector<std::vector<Stretch>> at_homes(static_cast<std::size_t>(process_count));
    for (std::size_t r = 0; r < runs.begin.size(); ++r) {
        std::uint64_t begin = runs.begin[r];
        const std::uint64_t end = begin + ancestors.first[r + 1] - ancestors.first[r];
        while (begin < end) {
            const int rank = homes.rank_of(begin);
            const std::uint64_t stop = std::min(end, homes.end_of(rank));
            auto& stretches = at_homes[static_cast<std::size_t>(rank)];
            if (!stretches.empty() && stretches.back().end == begin) {
                stretches.back().end = stop;
            } else {
                stretches.push_back({begin, stop});
            }
            begin = stop;
        }
    }
    return at_homes;
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
    std::vector<int> ranks;
    processes.transaction([&] {
        const CanonicalRuns runs = canonical_runs(processes, before);
        const Homes homes = homes_of_blocks(runs.count, 1, processes.size());
        const std::uint64_t first = homes.begin_of(processes.rank());
        std::vector<int> rank_of(static_cast<std::size_t>(homes.end_of(processes.rank()) - first));
        const auto inboxes =
            processes.all_to_all(stretches_at_homes(runs, before, homes, processes.size()));
        for (std::size_t rank = 0; rank < inboxes.size(); ++rank) {
            for (const Stretch& stretch : inboxes[rank]) {
                std::fill(rank_of.data() + (stretch.begin - first),
                          rank_of.data() + (stretch.end - first), static_cast<int>(rank));
            }
        }
        LocalFailure failure;
        const auto requests = request(processes, homes, roots, failure);
        ranks = fetch(processes, requests, rank_of, first, failure);
    });
    return ranks;
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
