#include <cstdio>

#include <gtest/gtest.h>

#include "distributed/world.hpp"
#include "support/mpi_shuffler.hpp"

/// Checks that the messages of this program are delayed and reordered, without which its other
/// tests, those of equality_test.cpp, would be meaningless.
namespace octetra::distributed {
namespace {

TEST(ShuffledMessages, AreDelayedAndReordered) {
    const Communicator& world = test::world();
    const auto size = static_cast<std::size_t>(world.size());
    for (int round = 0; round < 200; ++round) {
        std::vector<std::vector<int>> outboxes(size);
        for (std::size_t r = 0; r < size; ++r) outboxes[r].assign(r, world.rank() + round);
        const auto inboxes = world.all_to_all(outboxes);
        for (std::size_t r = 0; r < size; ++r) {
            const std::vector<int> expected(static_cast<std::size_t>(world.rank()),
                                            static_cast<int>(r) + round);
            EXPECT_EQ(inboxes[r], expected);
        }
    }
    const test::ShuffleCounts counts = test::shuffle_counts();
    EXPECT_GE(counts.held_back, 200 * (size - 1));
    EXPECT_GT(counts.late_calls, 0U);
    if (size > 2) {
        EXPECT_GT(counts.overtaken, 20U);
    }
    if (!world.is_first()) return;
    std::printf("rank 0, seed %llu: %llu messages held back, %llu overtaken, %llu calls late\n",
                static_cast<unsigned long long>(test::shuffle_seed()),
                static_cast<unsigned long long>(counts.held_back),
                static_cast<unsigned long long>(counts.overtaken),
                static_cast<unsigned long long>(counts.late_calls));
}

}  // namespace
}  // namespace octetra::distributed
