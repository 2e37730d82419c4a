#include "migrate/heavy_roots.hpp"

#include <algorithm>
#include <numeric>

namespace octetra::distributed {
namespace {

/// At most so many of all processes are heavy.
constexpr std::uint64_t most_heavy = 4096;
/// And none that is less than such a part of a mean load.
constexpr std::uint64_t parts_of_mean = 64;

/// The fullest process and the emptiest, and how much more the first has.
struct Uneven {
    int fullest = 0;
    int emptiest = 0;
    std::uint64_t gap = 0;

    /// What one has more than the other when so much more goes than comes.
    [[nodiscard]] std::uint64_t left(std::uint64_t weight) const {
        return weight > gap - weight ? 2 * weight - gap : gap - 2 * weight;
    }
    [[nodiscard]] bool helps(std::uint64_t weight) const { return weight > 0 && weight < gap; }
};

/// A root that goes from the fullest to the emptiest, and one that comes for it, if any.
struct Exchange {
    PlacedRoot* goes = nullptr;
    PlacedRoot* comes = nullptr;

    [[nodiscard]] std::uint64_t weight() const {
        return goes->weight - (comes == nullptr ? 0 : comes->weight);
    }
};

/// The one that leaves the two most alike; without a root that goes if none makes the most less.
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

/// The same of two roots, each of which takes the other's place.
Exchange best_swap(std::span<PlacedRoot> roots, const Uneven& uneven) {
    std::vector<PlacedRoot*> of_emptiest;
    for (PlacedRoot& root : roots) {
        if (root.rank == uneven.emptiest) of_emptiest.push_back(&root);
    }
    std::ranges::stable_sort(of_emptiest, {}, &PlacedRoot::weight);
    Exchange best;
    for (PlacedRoot& root : roots) {
        if (root.rank != uneven.fullest) continue;
        // The best are those next to what leaves both the same.
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
    // Loads become more alike each time, so this would end by itself, if not how soon.
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
        placed.resize(most_heavy);  // as many as there may be: all have room for what is told
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
