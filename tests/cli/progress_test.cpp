#include <pty.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "cli/octetra_program.hpp"
#include "support/temporary_folder.hpp"

/// Progress shown while the program works, and where it is shown.
namespace octetra {
namespace {

using namespace std::chrono_literals;

/// Runs `octetra ARGUMENTS` at a terminal and repeatedly stops it, so that its current check takes
/// more than a second. Returns the output on the terminal. Messages on stderr may be sent to a file
/// instead.
std::string output_at_slow_terminal(const std::string& arguments,
                                    const std::filesystem::path& folder,
                                    const std::string& file_for_stderr = "") {
    int terminal = -1;
    const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child < 0) throw std::runtime_error("forkpty failed");
    if (child == 0) {
        const auto words = test::words(std::string(OCTETRA_PROGRAM) + " " + arguments);
        std::vector<char*> argv;
        for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
        argv.push_back(nullptr);
        if (::chdir(folder.c_str()) != 0) ::_exit(127);
        if (!file_for_stderr.empty()) {
            ::dup2(::open(file_for_stderr.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
        }
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    std::jthread slow([child](const std::stop_token& ended) {
        while (!ended.stop_requested()) {
            ::kill(child, SIGSTOP);
            std::this_thread::sleep_for(1100ms);
            ::kill(child, SIGCONT);
            std::this_thread::sleep_for(20ms);
        }
    });
    std::string seen;
    std::array<char, 4096> buffer;
    for (ssize_t n = 0; (n = ::read(terminal, buffer.data(), buffer.size())) > 0;) {
        seen.append(buffer.data(), static_cast<std::size_t>(n));
    }
    slow.request_stop();
    slow.join();  // before the process id can be reused
    ::waitpid(child, nullptr, 0);
    ::close(terminal);
    return seen;
}

/// A mesh whose check is stopped several times.
const std::string generate_mesh =
    OCTETRA_SANITIZED ? "generate kuhn 10 10 10 -o mesh.ele" : "generate kuhn 20 20 20 -o mesh.ele";

TEST(VerifyProgress, IsShownAtATerminalWhereACheckTakesLongerThanASecond) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(test::octetra(generate_mesh, folder).status, 0);
    const std::string seen = output_at_slow_terminal("verify mesh.ele", folder.path());
    EXPECT_NE(seen.find(" %"), std::string::npos) << seen;
    EXPECT_NE(seen.find("mesh.ele: valid"), std::string::npos) << seen;
}

TEST(VerifyProgress, IsNotShownInFiles) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(test::octetra(generate_mesh, folder).status, 0);
    const std::string seen = output_at_slow_terminal("verify mesh.ele", folder.path(), "errors");
    EXPECT_EQ(seen.find(" %"), std::string::npos) << seen;
    EXPECT_EQ(test::content_of(folder / "errors"), "");
}

}  // namespace
}  // namespace octetra
