#include "migrate/heavy_roots.hpp"

#include <algorithm>
#include <numeric>

namespace octetra::distributed {
namespace {

/// The maximum number of heavy roots on all processes.
constexpr std::uint64_t most_heavy = 4096;
/// A heavy root weighs more than the mean load divided by this.
constexpr std::uint64_t parts_of_mean = 64;

/// The processes with the greatest and the smallest load, and the difference of their loads.
struct Uneven {
    int fullest = 0;
    int emptiest = 0;
    std::uint64_t gap = 0;

    /// Returns the difference after moving the net weight from the fullest to the emptiest process.
    [[nodiscard]] std::uint64_t left(std::uint64_t weight) const {
        return weight > gap - weight ? 2 * weight - gap : gap - 2 * weight;
    }
    [[nodiscard]] bool helps(std::uint64_t weight) const { return weight > 0 && weight < gap; }
};

/// A root that moves from the fullest to the emptiest process, and one that moves back, or null.
struct Exchange {
    PlacedRoot* goes = nullptr;
    PlacedRoot* comes = nullptr;

    [[nodiscard]] std::uint64_t weight() const {
        return goes->weight - (comes == nullptr ? 0 : comes->weight);
    }
};

/// Returns the move of one root that minimises the remaining difference; its `goes` is null if no
/// move reduces the greatest load.
Exchange best_move(std::span<PlacedRoot> roots, const Uneven& uneven) {
    Exchange best;
    for (PlacedRoot& root : roots) {
        if (root.rank != uneven.fullest || !uneven.helps(root.weight)) continue;
        if (best.goes == nullptr || uneven.left(root.weight) < uneven.left(best.weight())) {
            best.goes = &root;
        }
    }
    return best;
}

/// Same for swaps of two roots.
Exchange best_swap(std::span<PlacedRoot> roots, const Uneven& uneven) {
    std::vector<PlacedRoot*> of_emptiest;
    for (PlacedRoot& root : roots) {
        if (root.rank == uneven.emptiest) of_emptiest.push_back(&root);
    }
    std::ranges::stable_sort(of_emptiest, {}, &PlacedRoot::weight);
    Exchange best;
    for (PlacedRoot& root : roots) {
        if (root.rank != uneven.fullest) continue;
        // Candidates are the neighbours of the weight that would equalise the loads.
        const std::uint64_t wanted = root.weight - std::min(root.weight, uneven.gap / 2);
        const auto next = std::ranges::lower_bound(of_emptiest, wanted, {}, &PlacedRoot::weight);
        const auto first = next == of_emptiest.begin() ? next : next - 1;
        const auto last = next == of_emptiest.end() ? next : next + 1;
        for (auto comes = first; comes != last; ++comes) {
            const Exchange swap{&root, *comes};
            if ((*comes)->weight >= root.weight || !uneven.helps(swap.weight())) continue;
            if (best.goes == nullptr || uneven.left(swap.weight()) < uneven.left(best.weight())) {
                best = swap;
            }
        }
    }
    return best;
}

}  // namespace

void relieve(std::vector<std::uint64_t>& loads, std::span<PlacedRoot> roots, std::uint64_t goal) {
    // Each move reduces the difference, so the loop terminates; the limit bounds its time.
    for (std::size_t moves = 0; moves < 16 * roots.size(); ++moves) {
        const auto most = std::ranges::max_element(loads);
        const auto least = std::ranges::min_element(loads);
        if (most == loads.end() || *most <= goal) return;
        const Uneven uneven{static_cast<int>(most - loads.begin()),
                            static_cast<int>(least - loads.begin()), *most - *least};
        Exchange best = best_move(roots, uneven);
        if (best.goes == nullptr) best = best_swap(roots, uneven);
        if (best.goes == nullptr) return;
        *most -= best.weight();
        *least += best.weight();
        best.goes->rank = uneven.emptiest;
        if (best.comes != nullptr) best.comes->rank = uneven.fullest;
    }
}

bool relieve_of_heavy_roots(const Communicator& processes, std::span<const std::uint64_t> weights,
                            std::span<int> ranks, std::vector<std::uint64_t>& loads,
                            double most_over_mean, LocalFailure& failure) {
    const std::uint64_t sum = std::reduce(loads.begin(), loads.end());
    const std::uint64_t mean = sum / loads.size();
    const auto goal = static_cast<std::uint64_t>(most_over_mean * static_cast<double>(mean));
    if (*std::ranges::max_element(loads) <= goal) return true;

    const std::uint64_t heavy =
        std::max({sum / most_heavy, mean / parts_of_mean, std::uint64_t{1}});
    std::vector<PlacedRoot> here;
    std::vector<std::size_t> which;
    std::vector<int> placed;
    failure.attempt([&] {
        placed.resize(most_heavy);  // upper bound, so every process has memory for the broadcast
        for (std::size_t r = 0; r < weights.size(); ++r) {
            if (weights[r] <= heavy) continue;
            here.push_back({weights[r], ranks[r]});
            which.push_back(r);
        }
    });
    if (failure.max_unless_failed(processes, 0) == LocalFailure::somewhere) return false;
    const std::uint64_t before = processes.sum_before(here.size());
    failure.attempt([&] {
        const auto gathered = processes.gather(here);
        if (!processes.is_first()) return;
        std::vector<PlacedRoot> all;
        for (const auto& of_one : gathered) all.insert(all.end(), of_one.begin(), of_one.end());
        relieve(loads, all, goal);
        std::ranges::transform(all, placed.begin(), &PlacedRoot::rank);
    });
    if (failure.max_unless_failed(processes, 0) == LocalFailure::somewhere) return false;
    processes.broadcast(placed);
    processes.broadcast(loads);
    for (std::size_t k = 0; k < which.size(); ++k) ranks[which[k]] = placed[before + k];
    return true;
}

}  // namespace octetra::distributed
