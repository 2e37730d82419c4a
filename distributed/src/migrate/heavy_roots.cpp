#include "migrate/heavy_roots.hpp"

#include <algorithm>
#include <numeric>

namespace octetra::distributed {
namespace {

/// At most so many of all processes are heavy.
constexpr std::uint64_t most_heavy = 4096;
/// And none that is less than such a part of a mean load.
constexpr std::uint64_t parts_of_mean = 64;

/// Of the roots of one process the one that leaves two, one of which has `gap` more, most alike;
/// roots.end() if none makes the most of them less.
auto best_to_move(std::span<PlacedRoot> roots, int from, std::uint64_t gap) {
    const auto left = [gap](std::uint64_t weight) {  // what one has more than the other then
        return weight > gap - weight ? 2 * weight - gap : gap - 2 * weight;
    };
    auto best = roots.end();
    for (auto root = roots.begin(); root != roots.end(); ++root) {
        if (root->rank != from || root->weight == 0 || root->weight >= gap) continue;
        if (best == roots.end() || left(root->weight) < left(best->weight)) best = root;
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
        const auto root =
            best_to_move(roots, static_cast<int>(most - loads.begin()), *most - *least);
        if (root == roots.end()) return;
        *most -= root->weight;
        *least += root->weight;
        root->rank = static_cast<int>(least - loads.begin());
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
