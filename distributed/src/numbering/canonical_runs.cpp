#include "numbering/canonical_runs.hpp"

#include <span>

namespace octetra::distributed {
namespace {

/// Roots meet at a process that their number decides: the first has the first block of numbers, and
/// so on.
struct Blocks {
    std::uint64_t size = 0;

    Blocks(const Communicator& processes, const AncestorMap& ancestors) {
        const auto& roots = ancestors.roots;
        const std::uint64_t count = processes.max(roots.empty() ? 0 : roots.back() + 1);
        size = count / static_cast<std::uint64_t>(processes.size()) + 1;
    }
    [[nodiscard]] std::uint64_t begin_of(std::size_t rank) const { return size * rank; }
};

/// A root of the mesh in its block, and how many descendants it has.
struct Root {
    std::uint32_t place;
    std::uint32_t descendants;
};

/// Of this process's roots those of each block; as roots are ascending, one after the other.
std::vector<std::vector<Root>> roots_of_blocks(const AncestorMap& ancestors, const Blocks& blocks,
                                               std::size_t process_count) {
    std::vector<std::vector<Root>> of_blocks(process_count);
    std::size_t r = 0;
    for (std::size_t rank = 0; rank < process_count; ++rank) {
        const std::uint64_t begin = blocks.begin_of(rank);
        const auto from = ancestors.roots.begin() + static_cast<std::ptrdiff_t>(r);
        const auto to = std::lower_bound(from, ancestors.roots.end(), begin + blocks.size);
        of_blocks[rank].reserve(static_cast<std::size_t>(to - from));
        for (const auto end = static_cast<std::size_t>(to - ancestors.roots.begin()); r < end;
             ++r) {
            of_blocks[rank].push_back(
                {static_cast<std::uint32_t>(ancestors.roots[r] - begin),
                 static_cast<std::uint32_t>(ancestors.first[r + 1] - ancestors.first[r])});
        }
    }
    return of_blocks;
}

}  // namespace

CanonicalRuns canonical_runs(const Communicator& processes, const AncestorMap& ancestors) {
    const Blocks blocks(processes, ancestors);
    const auto process_count = static_cast<std::size_t>(processes.size());
    const auto inboxes = processes.all_to_all(roots_of_blocks(ancestors, blocks, process_count));

    std::vector<std::uint64_t> number(blocks.size, 0);  // of descendants, then of the first of them
    std::uint64_t own = 0;
    for (const auto& inbox : inboxes) {
        for (const Root& root : inbox) {
            number[root.place] = root.descendants;
            own += root.descendants;
        }
    }
    std::uint64_t next = processes.sum_before(own);
    for (std::uint64_t& n : number) {
        const std::uint64_t descendants = n;
        n = next;
        next += descendants;
    }

    std::vector<std::vector<std::uint64_t>> replies(process_count);
    for (std::size_t rank = 0; rank < process_count; ++rank) {
        replies[rank].reserve(inboxes[rank].size());
        for (const Root& root : inboxes[rank]) replies[rank].push_back(number[root.place]);
    }
    // Roots are ascending, so the answers come in their order.
    CanonicalRuns runs{.count = processes.sum(own)};
    runs.begin.reserve(ancestors.roots.size());
    for (const auto& answers : processes.all_to_all(replies)) {
        runs.begin.insert(runs.begin.end(), answers.begin(), answers.end());
    }
    return runs;
}

}  // namespace octetra::distributed
