#include "migrate/heavy_roots.hpp"

#include <algorithm>
#include <numeric>

namespace octetra::distributed {
namespace {

/// The maximum number of heavy roots on all processes.
constexpr std::uint64_t max_heavy_roots = 4096;
/// A heavy root weighs more than the mean load divided by this.
constexpr std::uint64_t mean_divisor = 64;

/// The processes with the greatest and the smallest load, and the difference of their loads.
struct LoadGap {
    int fullest = 0;
    int emptiest = 0;
    std::uint64_t gap = 0;

    /// Returns the difference after moving the net weight from the fullest to the emptiest process.
    [[nodiscard]] std::uint64_t left(std::uint64_t weight) const {
        return weight > gap - weight ? 2 * weight - gap : gap - 2 * weight;
    }
    [[nodiscard]] bool reduces_peak(std::uint64_t weight) const {
        return weight > 0 && weight < gap;
    }
};

/// A root that moves from the fullest to the emptiest process, and one that moves back, or null.
struct Exchange {
    AssignedRoot* outgoing = nullptr;
    AssignedRoot* incoming = nullptr;

    [[nodiscard]] std::uint64_t weight() const {
        return outgoing->weight - (incoming == nullptr ? 0 : incoming->weight);
    }
};

/// Returns the move of one root that minimises the remaining difference; its `outgoing` is null if
/// no move reduces the greatest load.
Exchange best_move(std::span<AssignedRoot> roots, const LoadGap& load_gap) {
    Exchange best;
    for (AssignedRoot& root : roots) {
        if (root.rank != load_gap.fullest || !load_gap.reduces_peak(root.weight)) continue;
        if (best.outgoing == nullptr || load_gap.left(root.weight) < load_gap.left(best.weight())) {
            best.outgoing = &root;
        }
    }
    return best;
}

/// Same for swaps of two roots.
Exchange best_swap(std::span<AssignedRoot> roots, const LoadGap& load_gap) {
    std::vector<AssignedRoot*> of_emptiest;
    for (AssignedRoot& root : roots) {
        if (root.rank == load_gap.emptiest) of_emptiest.push_back(&root);
    }
    std::ranges::stable_sort(of_emptiest, {}, &AssignedRoot::weight);
    Exchange best;
    for (AssignedRoot& root : roots) {
        if (root.rank != load_gap.fullest) continue;
        // Candidates are the neighbours of the weight that would equalise the loads.
        const std::uint64_t wanted = root.weight - std::min(root.weight, load_gap.gap / 2);
        const auto next = std::ranges::lower_bound(of_emptiest, wanted, {}, &AssignedRoot::weight);
        const auto first = next == of_emptiest.begin() ? next : next - 1;
        const auto last = next == of_emptiest.end() ? next : next + 1;
        for (auto incoming = first; incoming != last; ++incoming) {
            const Exchange swap{&root, *incoming};
            if ((*incoming)->weight >= root.weight || !load_gap.reduces_peak(swap.weight()))
                continue;
            if (best.outgoing == nullptr ||
                load_gap.left(swap.weight()) < load_gap.left(best.weight())) {
                best = swap;
            }
        }
    }
    return best;
}

}  // namespace

void balance_loads(std::vector<std::uint64_t>& loads, std::span<AssignedRoot> roots,
                   std::uint64_t goal) {
    // Each move reduces the difference, so the loop terminates; the limit bounds its time.
    for (std::size_t moves = 0; moves < 16 * roots.size(); ++moves) {
        const auto most = std::ranges::max_element(loads);
        const auto least = std::ranges::min_element(loads);
        if (most == loads.end() || *most <= goal) return;
        const LoadGap load_gap{static_cast<int>(most - loads.begin()),
                               static_cast<int>(least - loads.begin()), *most - *least};
        Exchange best = best_move(roots, load_gap);
        if (best.outgoing == nullptr) best = best_swap(roots, load_gap);
        if (best.outgoing == nullptr) return;
        *most -= best.weight();
        *least += best.weight();
        best.outgoing->rank = load_gap.emptiest;
        if (best.incoming != nullptr) best.incoming->rank = load_gap.fullest;
    }
}

void balance_heavy_roots(const Communicator& processes, std::span<const std::uint64_t> weights,
                         std::span<int> ranks, std::vector<std::uint64_t>& loads,
                         double most_over_mean) {
    const std::uint64_t sum = std::reduce(loads.begin(), loads.end());
    const std::uint64_t mean = sum / loads.size();
    const auto goal = static_cast<std::uint64_t>(most_over_mean * static_cast<double>(mean));
    if (*std::ranges::max_element(loads) <= goal) return;

    const std::uint64_t heavy =
        std::max({sum / max_heavy_roots, mean / mean_divisor, std::uint64_t{1}});
    std::vector<AssignedRoot> here;
    std::vector<std::size_t> which;
    for (std::size_t r = 0; r < weights.size(); ++r) {
        if (weights[r] <= heavy) continue;
        here.push_back({weights[r], ranks[r]});
        which.push_back(r);
    }
    const std::uint64_t before = processes.sum_before(here.size());
    std::vector<AssignedRoot> all;
    for (const auto& of_one : processes.gather(here)) {
        all.insert(all.end(), of_one.begin(), of_one.end());
    }
    if (processes.is_first()) balance_loads(loads, all, goal);
    std::vector<int> assigned(all.size());
    std::ranges::transform(all, assigned.begin(), &AssignedRoot::rank);
    processes.broadcast(assigned);
    processes.broadcast(loads);
    for (std::size_t k = 0; k < which.size(); ++k) ranks[which[k]] = assigned[before + k];
}

}  // namespace octetra::distributed
