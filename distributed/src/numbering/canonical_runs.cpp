#include "numbering/canonical_runs.hpp"

#include <functional>
#include <limits>
#include <span>
#include <utility>

namespace octetra::distributed {
namespace {

/// Distributes root numbers to rendezvous processes in blocks of equal size, in the order of ranks.
struct Blocks {
    std::uint64_t size = 0;

    Blocks(const Communicator& processes, const AncestorMap& ancestors) {
        const auto& roots = ancestors.roots;
        const std::uint64_t count = processes.max(roots.empty() ? 0 : roots.back() + 1);
        size = count / static_cast<std::uint64_t>(processes.size()) + 1;
    }
    [[nodiscard]] std::uint64_t begin_of(std::size_t rank) const { return size * rank; }
};

/// A run of consecutive roots of one process in a block with equal numbers of descendants.
struct EqualRootRun {
    std::uint32_t first;  ///< first root, relative to the start of the block
    std::uint32_t count;
    std::uint32_t descendants;  ///< of each root

    [[nodiscard]] std::uint64_t entities() const { return std::uint64_t{count} * descendants; }
};

/// Returns this process's roots, grouped by block; the roots are ascending.
std::vector<std::vector<EqualRootRun>> roots_of_blocks(const AncestorMap& ancestors,
                                                       const Blocks& blocks,
                                                       std::size_t process_count) {
    std::vector<std::vector<EqualRootRun>> of_blocks(process_count);
    std::size_t r = 0;
    for (std::size_t rank = 0; rank < process_count; ++rank) {
        const std::uint64_t begin = blocks.begin_of(rank);
        const std::uint64_t end = begin + blocks.size;
        auto& of_block = of_blocks[rank];
        for (; r < ancestors.roots.size() && ancestors.roots[r] < end; ++r) {
            const auto position = static_cast<std::uint32_t>(ancestors.roots[r] - begin);
            const auto descendants =
                static_cast<std::uint32_t>(ancestors.first[r + 1] - ancestors.first[r]);
            if (!of_block.empty() && of_block.back().first + of_block.back().count == position &&
                of_block.back().descendants == descendants) {
                ++of_block.back().count;
            } else {
                of_block.push_back({position, 1, descendants});
            }
        }
    }
    return of_blocks;
}

/// Returns, for each run in a block, received from each process, the number of its first
/// descendant. The numbers of the block start with `next`.
std::vector<std::vector<std::uint64_t>> numbers_in_block(
    const std::vector<std::vector<EqualRootRun>>& from_each, std::uint64_t next) {
    std::vector<std::vector<std::uint64_t>> numbers(from_each.size());
    // a heap of pairs (first root, rank)
    std::vector<std::pair<std::uint32_t, std::size_t>> queue;
    const auto enqueue = [&](std::size_t rank) {
        const std::size_t k = numbers[rank].size();
        if (k == from_each[rank].size()) return;
        queue.emplace_back(from_each[rank][k].first, rank);
        std::ranges::push_heap(queue, std::greater{});
    };
    for (std::size_t rank = 0; rank < from_each.size(); ++rank) {
        numbers[rank].reserve(from_each[rank].size());
        enqueue(rank);
    }
    while (!queue.empty()) {
        const std::size_t rank = queue.front().second;
        std::ranges::pop_heap(queue, std::greater{});
        queue.pop_back();
        const std::uint64_t end =
            queue.empty() ? std::numeric_limits<std::uint64_t>::max() : queue.front().first;
        for (const EqualRootRun& roots : std::span(from_each[rank]).subspan(numbers[rank].size())) {
            if (roots.first >= end) break;
            numbers[rank].push_back(next);
            next += roots.entities();
        }
        enqueue(rank);
    }
    return numbers;
}

}  // namespace

CanonicalRuns canonical_runs(const Communicator& processes, const AncestorMap& ancestors) {
    const Blocks blocks(processes, ancestors);
    const auto process_count = static_cast<std::size_t>(processes.size());
    const auto of_blocks = roots_of_blocks(ancestors, blocks, process_count);
    const auto from_each = processes.all_to_all(of_blocks);
    std::uint64_t own = 0;
    for (const auto& from_one : from_each) {
        for (const EqualRootRun& roots : from_one) own += roots.entities();
    }
    const auto numbers =
        processes.all_to_all(numbers_in_block(from_each, processes.sum_before(own)));

    CanonicalRuns runs{.count = processes.sum(own)};
    runs.begin.reserve(ancestors.roots.size());
    for (std::size_t rank = 0; rank < process_count; ++rank) {
        for (std::size_t k = 0; k < numbers[rank].size(); ++k) {
            const EqualRootRun& roots = of_blocks[rank][k];
            for (std::uint64_t i = 0; i < roots.count; ++i) {
                runs.begin.push_back(numbers[rank][k] + i * roots.descendants);
            }
        }
    }
    return runs;
}

std::pair<std::size_t, std::size_t> local_range(const CanonicalRuns& runs,
                                                const AncestorMap& ancestors, std::uint64_t begin,
                                                std::uint64_t end) {
    // The local index of this process's first entity whose number is at least `number`.
    const auto local_from = [&](std::uint64_t number) -> std::size_t {
        const auto after = std::ranges::upper_bound(runs.begin, number);
        if (after == runs.begin.begin()) return 0;
        const auto r = static_cast<std::size_t>(after - runs.begin.begin()) - 1;
        const std::uint64_t length = ancestors.first[r + 1] - ancestors.first[r];
        return ancestors.first[r] + std::min(length, number - runs.begin[r]);
    };
    return {local_from(begin), local_from(end)};
}

}  // namespace octetra::distributed
