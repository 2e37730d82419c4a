#include "child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

namespace octetra::generator {
namespace {

[[noreturn]] void fail(const char* doing) {
    throw SystemError(fmt::format("{} failed: {}", doing, std::strerror(errno)));
}

void discard_output() {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
}

/// Ensures that the child is killed if the parent terminates.
void die_with_parent(pid_t parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(EXIT_FAILURE);  // the parent has already terminated
}

/// Resets signal handlers: those of the parent, a sanitizer's for example, would end the child with
/// a different exit status.
void reset_signal_handlers() {
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
        std::signal(signal, SIG_DFL);
}

[[noreturn]] void run_child(int pipe_end, const std::function<int(ToParent&)>& work) noexcept {
    discard_output();
    reset_signal_handlers();
    const rlimit no_core_file{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core_file);
    ToParent parent(pipe_end);
    ::_exit(work(parent));
}

/// Reads all bytes from the pipe until the other end is closed.
std::vector<std::byte> receive(int pipe_end) {
    std::vector<std::byte> bytes;
    std::vector<std::byte> buffer(std::size_t{1} << 16U);
    while (true) {
        const ssize_t got = ::read(pipe_end, buffer.data(), buffer.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail("reading from a process");
        if (got == 0) return bytes;
        bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + got);
    }
}

int wait_for(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) fail("waiting for a process");
    }
    return status;
}

/// Closes the parent's end of the pipe and waits for the child, also after an exception.
class Child {
public:
    Child(pid_t process, int pipe_end) : process_(process), pipe_end_(pipe_end) {}
    ~Child() {
        ::close(pipe_end_);
        int ignored = 0;
        if (process_ > 0) ::waitpid(process_, &ignored, 0);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    Child(Child&&) = delete;
    Child& operator=(Child&&) = delete;

    ChildResult finish() {
        ChildResult result{.sent = receive(pipe_end_)};
        const int status = wait_for(std::exchange(process_, 0));
        if (WIFEXITED(status)) result.exit_status = WEXITSTATUS(status);
        if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
        return result;
    }

private:
    pid_t process_;
    int pipe_end_;
};

}  // namespace

void ToParent::send(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t put = ::write(file_, bytes.data(), bytes.size());
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) ::_exit(EXIT_FAILURE);
        bytes = bytes.subspan(static_cast<std::size_t>(put));
    }
}

ChildResult run_in_child(const std::function<int(ToParent&)>& work) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("making a pipe");
    const auto [read_end, write_end] = ends;
    const pid_t parent = ::getpid();
    const pid_t process = ::fork();
    if (process < 0) {
        ::close(read_end);
        ::close(write_end);
        fail("starting a process");
    }
    if (process == 0) {
        ::close(read_end);
        die_with_parent(parent);
        run_child(write_end, work);
    }
    ::close(write_end);
    return Child(process, read_end).finish();
}

}  // namespace octetra::generator
