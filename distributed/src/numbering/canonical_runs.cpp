#include "numbering/canonical_runs.hpp"

namespace octetra::distributed {

CanonicalRuns canonical_runs(const Communicator& processes, const AncestorMap& ancestors) {
    // Roots meet, each with the number of its descendants, at a process that their number decides:
    // the first process has the first block of numbers, and so on.
    const auto process_count = static_cast<std::uint64_t>(processes.size());
    const std::uint64_t root_count =
        processes.max(ancestors.roots.empty() ? 0 : ancestors.roots.back() + 1);
    const std::uint64_t block = root_count / process_count + 1;
    struct Root {
        std::uint64_t number;
        std::uint64_t descendants;
    };
    std::vector<std::vector<Root>> outboxes(process_count);
    for (std::size_t r = 0; r < ancestors.roots.size(); ++r) {
        outboxes[ancestors.roots[r] / block].push_back(
            {ancestors.roots[r], ancestors.first[r + 1] - ancestors.first[r]});
    }
    const auto inboxes = processes.all_to_all(outboxes);

    const std::uint64_t first_root = block * static_cast<std::uint64_t>(processes.rank());
    std::vector<std::uint64_t> number(block, 0);  // of descendants, then of the first of them
    for (const auto& inbox : inboxes) {
        for (const Root& root : inbox) number[root.number - first_root] = root.descendants;
    }
    std::uint64_t own = 0;
    for (const std::uint64_t descendants : number) own += descendants;
    std::uint64_t next = processes.sum_before(own);
    for (std::uint64_t& n : number) {
        const std::uint64_t descendants = n;
        n = next;
        next += descendants;
    }

    std::vector<std::vector<std::uint64_t>> replies(process_count);
    for (std::size_t rank = 0; rank < inboxes.size(); ++rank) {
        for (const Root& root : inboxes[rank]) {
            replies[rank].push_back(number[root.number - first_root]);
        }
    }
    // Roots are ascending, so the answers come in their order.
    CanonicalRuns runs{.count = processes.sum(own)};
    for (const auto& answers : processes.all_to_all(replies)) {
        runs.begin.insert(runs.begin.end(), answers.begin(), answers.end());
    }
    return runs;
}

}  // namespace octetra::distributed
