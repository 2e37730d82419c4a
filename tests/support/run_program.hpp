#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace octetra::test {

struct Outcome {
    int status = -1;  ///< exit status, or 128 + the number of the signal that ended it
    std::string out;
    std::string err;
};

/// Runs a program in a folder and captures its output.
inline Outcome run_program(const std::vector<std::string>& command,
                           const std::filesystem::path& folder) {
    const TemporaryFolder caught;
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("fork failed");
    if (child == 0) {
        const auto send = [](const std::filesystem::path& file, int stream) {
            ::dup2(::open(file.c_str(), O_WRONLY | O_CREAT, 0600), stream);
        };
        send(caught / "out", STDOUT_FILENO);
        send(caught / "err", STDERR_FILENO);
        std::vector<char*> argv;
        for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
        argv.push_back(nullptr);
        if (::chdir(folder.c_str()) == 0) ::execvp(argv[0], argv.data());
        ::_exit(127);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            content_of(caught / "out"), content_of(caught / "err")};
}

/// Returns whether this status of mpirun reports that a signal ended a rank. Open MPI adds 128 to
/// the number of the signal; MPICH returns the number, or that of SIGKILL, by which it ends the
/// other ranks.
inline bool reports_signal(int status, int signal) {
    return status == 128 + signal || status == signal || status == SIGKILL;
}

/// Splits at blanks, which suffices for the command lines of tests.
inline std::vector<std::string> words(const std::string& line) {
    std::istringstream in(line);
    std::vector<std::string> result;
    for (std::string word; in >> word;) result.push_back(word);
    return result;
}

}  // namespace octetra::test
