#include <cstdio>

#include <gtest/gtest.h>

#include <octetra/distributed/communicator.hpp>

#include "distributed/world.hpp"

namespace octetra::test {

const distributed::Communicator*& world_pointer() {
    static const distributed::Communicator* pointer = nullptr;
    return pointer;
}

const distributed::Communicator& world() { return *world_pointer(); }

}  // namespace octetra::test

/// The main() of tests under mpirun: all ranks run the same tests in the same order, and all exit
/// with failure if one fails.
int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    octetra::test::world_pointer() = &session.world();
    testing::InitGoogleTest(&argc, argv);
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    if (!session.world().is_first()) delete listeners.Release(listeners.default_result_printer());
    const int failed = RUN_ALL_TESTS();
    const auto failed_ranks = session.world().sum(failed == 0 ? 0 : 1);
    if (session.world().is_first() && failed_ranks > 0) {
        std::printf("tests failed on %d ranks\n", static_cast<int>(failed_ranks));
    }
    octetra::test::world_pointer() = nullptr;
    return failed_ranks == 0 ? 0 : 1;
}
