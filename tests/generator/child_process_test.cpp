#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include <gtest/gtest.h>

#include "child_process.hpp"

namespace octetra::generator {
namespace {

/// The child holds the write end of a pipe, which is closed when the child ends.
TEST(ChildProcess, EndsWhenItsParentIsKilled) {
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    const auto [read_end, write_end] = ends;
    const pid_t parent = ::fork();
    ASSERT_GE(parent, 0);
    if (parent == 0) {
        ::close(read_end);
        (void)run_in_child([&, write_end = write_end](ToParent&) {
            if (::write(write_end, "!", 1) != 1) return 1;
            constexpr unsigned much_longer_than_the_test_waits = 300;
            ::sleep(much_longer_than_the_test_waits);
            return 0;
        });
        ::_exit(0);
    }
    ::close(write_end);
    char begun = 0;
    ASSERT_EQ(::read(read_end, &begun, 1), 1);
    ASSERT_EQ(::kill(parent, SIGKILL), 0);
    int ignored = 0;
    ASSERT_EQ(::waitpid(parent, &ignored, 0), parent);
    pollfd pipe{.fd = read_end, .events = POLLIN, .revents = 0};
    constexpr int milliseconds = 60'000;
    ASSERT_EQ(::poll(&pipe, 1, milliseconds), 1) << "the child continues without its parent";
    EXPECT_EQ(::read(read_end, &begun, 1), 0);
    ::close(read_end);
}

/// TetGen sometimes ends in this way. Sanitizers install such handlers, and so may a program that
/// uses the library.
TEST(ChildProcess, EndsByItsSignalWhateverItsParentDoesAboutIt) {
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE}) {
        auto* const before = std::signal(signal, [](int) { ::_exit(1); });
        const ChildResult result = run_in_child([&](ToParent&) { return std::raise(signal); });
        (void)std::signal(signal, before);
        EXPECT_EQ(result.signal, signal);
        EXPECT_EQ(result.exit_status, 0);
    }
}

}  // namespace
}  // namespace octetra::generator
