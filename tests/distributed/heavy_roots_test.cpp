#include "migrate/heavy_roots.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace octetra::distributed {
namespace {

/// Roots on random processes, some of which have further load besides these roots.
struct Placed {
    explicit Placed(std::uint64_t seed) {
        std::mt19937_64 random(seed);
        const std::size_t processes = 1 + random() % 6;
        for (std::size_t rank = 0; rank < processes; ++rank) loads.push_back(random() % 50);
        for (std::size_t count = random() % 40; count > 0; --count) {
            const auto rank = static_cast<int>(random() % processes);
            roots.push_back({random() % 30, rank});
            loads[static_cast<std::size_t>(rank)] += roots.back().weight;
        }
    }
    [[nodiscard]] std::uint64_t most() const { return std::ranges::max(loads); }

    std::vector<std::uint64_t> loads;
    std::vector<AssignedRoot> roots;
};

/// Returns whether the loads of processes agree with the new ranks of the roots.
bool are_loads_of(const Placed& after, const Placed& before) {
    std::vector<std::uint64_t> loads = before.loads;
    for (std::size_t i = 0; i < before.roots.size(); ++i) {
        if (after.roots[i].weight != before.roots[i].weight) return false;
        loads[static_cast<std::size_t>(before.roots[i].rank)] -= before.roots[i].weight;
        loads[static_cast<std::size_t>(after.roots[i].rank)] += before.roots[i].weight;
    }
    return loads == after.loads;
}

TEST(HeavyRoots, MoveUntilNoMoveAndNoSwapImprovesTheBalance) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const Placed before(seed);
        Placed after = before;
        balance_loads(after.loads, after.roots, 0);
        ASSERT_TRUE(are_loads_of(after, before)) << "seed " << seed;
        ASSERT_LE(after.most(), before.most()) << "seed " << seed;
        const auto most = std::ranges::max_element(after.loads);
        const auto least = std::ranges::min_element(after.loads);
        const std::uint64_t gap = *most - *least;
        std::vector<std::uint64_t> of_least{0};  // a root may move without a swap
        for (const AssignedRoot& root : after.roots) {
            if (root.rank == least - after.loads.begin()) of_least.push_back(root.weight);
        }
        for (const AssignedRoot& root : after.roots) {
            if (root.rank != most - after.loads.begin()) continue;
            for (const std::uint64_t comes : of_least) {
                ASSERT_TRUE(root.weight <= comes || root.weight - comes >= gap) << "seed " << seed;
            }
        }
    }
}

TEST(HeavyRoots, StayIfNoProcessExceedsTheGoal) {
    int reached = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const Placed before(seed);
        Placed after = before;
        balance_loads(after.loads, after.roots, before.most());
        ASSERT_EQ(after.loads, before.loads) << "seed " << seed;
        const std::uint64_t goal = before.most() - before.most() / 8;
        balance_loads(after.loads, after.roots, goal);
        if (after.most() > goal) continue;
        ++reached;
        Placed further = after;
        balance_loads(further.loads, further.roots, goal);
        ASSERT_EQ(further.loads, after.loads) << "seed " << seed;
    }
    EXPECT_GT(reached, 500);
}

TEST(HeavyRoots, OfEqualWeightsAreSharedOutEvenly) {
    Placed all(0);
    all.loads = {12, 0, 0, 0};
    all.roots.assign(12, {1, 0});
    balance_loads(all.loads, all.roots, 3);
    EXPECT_EQ(all.loads, (std::vector<std::uint64_t>{3, 3, 3, 3}));
}

TEST(HeavyRoots, MoveByTheResultingBalanceAndNotByWeight) {
    Placed all(0);
    all.loads = {20, 10};
    all.roots = {{9, 0}, {5, 0}};
    balance_loads(all.loads, all.roots, 19);  // either would do; no swap follows
    EXPECT_EQ(all.loads, (std::vector<std::uint64_t>{15, 15}));
}

TEST(HeavyRoots, AreSwappedIfNoneCanMoveAlone) {
    Placed all(0);
    all.loads = {14, 6};
    all.roots = {{14, 0}, {6, 1}};
    balance_loads(all.loads, all.roots, 0);
    EXPECT_EQ(all.loads, (std::vector<std::uint64_t>{14, 6}));  // else loads are merely exchanged
    all.loads = {20, 16};
    all.roots = {{10, 0}, {10, 0}, {8, 1}, {8, 1}};
    balance_loads(all.loads, all.roots, 0);
    EXPECT_EQ(all.loads, (std::vector<std::uint64_t>{18, 18}));
}

}  // namespace
}  // namespace octetra::distributed
