#pragma once

#include <cstdint>
#include <new>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <octetra/distributed/out_of_memory.hpp>

#include "distributed/world.hpp"

/// The operator new of a program that has this refuses an allocation when it is told to.
namespace octetra::test {

constexpr long never = -1;

/// How many allocations succeed before one is refused, and whether only that one is.
inline long allocations_left = never;
inline bool refuses_one_alone = false;

/// Does `work` on all processes, while on `rank` only so many allocations succeed. Did it get
/// there?
bool done_with(long allocations, int rank, auto&& work) {
    if (world().rank() == rank) allocations_left = allocations;
    bool done = true;
    try {
        work();
    } catch (const distributed::OutOfMemory& error) {
        allocations_left = never;
        EXPECT_STREQ(error.what(), fmt::format("rank {}: out of memory", rank).c_str());
        done = false;
    } catch (const std::bad_alloc&) {  // of an exchange by itself, which tells nobody
        done = false;
    }
    allocations_left = never;
    return done;
}

/// Collective. Lets allocations of some work that begins anew each time fail in turn on each of the
/// processes, the first fifty one after the other, later ones with ever more between them; when
/// none fails any more, the work is done on all. Returns how many that were.
std::uint64_t let_each_fail_anew(auto&& work) {
    const distributed::Communicator& all = world();
    std::uint64_t failures = 0;
    for (int rank = 0; rank < all.size(); ++rank) {
        for (long allocations = 0;; allocations += 1 + allocations / 50) {
            const bool done = done_with(allocations, rank, work);
            const auto done_on = static_cast<int>(all.sum(done ? 1 : 0));
            EXPECT_EQ(done_on, done ? all.size() : 0) << allocations;
            if (done_on > 0) break;
            ++failures;
        }
    }
    return failures;
}

}  // namespace octetra::test
