#pragma once

#include <cstdint>
#include <new>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <octetra/distributed/out_of_memory.hpp>

#include "distributed/world.hpp"

/// Replaces operator new by one that refuses an allocation on request.
namespace octetra::test {

constexpr long never = -1;

/// The number of allocations that succeed before one is refused, and whether only that one is.
inline long allocations_left = never;
inline bool refuses_only_one = false;

/// Performs `work` on all processes; on `rank` only this number of allocations succeed. Returns
/// whether the work was completed.
bool try_work(long allocations, int rank, auto&& work) {
    if (world().rank() == rank) allocations_left = allocations;
    bool done = true;
    try {
        work();
    } catch (const distributed::OutOfMemory& error) {
        allocations_left = never;
        EXPECT_STREQ(error.what(), fmt::format("rank {}: out of memory", rank).c_str());
        done = false;
    } catch (const std::bad_alloc&) {  // an exchange alone reports no failure
        done = false;
    }
    allocations_left = never;
    return done;
}

/// Collective. Repeats work that starts anew each time, and refuses allocations in turn on each
/// process: each of the first fifty, and later ones with growing gaps, until the work is completed
/// on all. Returns the number of refused allocations.
std::uint64_t fail_each_allocation(auto&& work) {
    const distributed::Communicator& all = world();
    std::uint64_t failures = 0;
    for (int rank = 0; rank < all.size(); ++rank) {
        for (long allocations = 0;; allocations += 1 + allocations / 50) {
            const bool done = try_work(allocations, rank, work);
            const auto done_on = static_cast<int>(all.sum(done ? 1 : 0));
            EXPECT_EQ(done_on, done ? all.size() : 0) << allocations;
            if (done_on > 0) break;
            ++failures;
        }
    }
    return failures;
}

}  // namespace octetra::test
