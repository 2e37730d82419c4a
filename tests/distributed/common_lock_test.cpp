#include "comm/common_lock.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace octetra::distributed {
namespace {

class CommonLock : public testing::Test {
protected:
    [[nodiscard]] int open() const {
        return ::open((folder / "lock").c_str(), O_RDWR | O_CREAT, 0600);
    }

    /// Starts a process that takes the lock, lives for a while, and reports by its exit status
    /// whether it was the first. Returns when it holds the lock.
    [[nodiscard]] pid_t start_holder(std::chrono::milliseconds life) const {
        std::array<int, 2> ends{};
        EXPECT_EQ(::pipe(ends.data()), 0);
        const pid_t child = ::fork();
        if (child == 0) {
            const bool first = try_claim(open());
            if (::write(ends[1], "x", 1) != 1) ::_exit(EXIT_FAILURE);
            std::this_thread::sleep_for(life);
            ::_exit(first ? EXIT_SUCCESS : EXIT_FAILURE);
        }
        char taken = 0;
        EXPECT_EQ(::read(ends[0], &taken, 1), 1);
        ::close(ends[0]);
        ::close(ends[1]);
        return child;
    }

    const test::TemporaryFolder folder;
};

bool was_first(pid_t child) {
    int status = EXIT_FAILURE;
    ::waitpid(child, &status, 0);
    return status == EXIT_SUCCESS;
}

TEST_F(CommonLock, IsAcquiredOnceAlsoAfterItsHolderHasEnded) {
    const pid_t holder = start_holder(std::chrono::milliseconds(0));
    EXPECT_TRUE(was_first(holder));
    const int lock = open();
    EXPECT_FALSE(try_claim(lock));
    ::close(lock);
}

TEST_F(CommonLock, BlocksOthersUntilItsHolderHasEnded) {
    const pid_t holder = start_holder(std::chrono::milliseconds(200));
    const auto start = std::chrono::steady_clock::now();
    const int lock = open();
    EXPECT_FALSE(try_claim(lock));
    EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(100));
    EXPECT_TRUE(was_first(holder));
    ::close(lock);
}

TEST_F(CommonLock, IsAcquiredByEveryCallerIfThereIsNone) {
    EXPECT_TRUE(try_claim(-1));
    EXPECT_TRUE(try_claim(-1));
}

}  // namespace
}  // namespace octetra::distributed
