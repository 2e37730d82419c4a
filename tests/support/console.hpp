#pragma once

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/run_program.hpp"

/// Commands as at a console, with the output that they must print.
///
/// A line "$ COMMAND" is run by bash and must end in status 0, "2$ COMMAND" in status 2. Lines
/// "> MORE" continue it. The lines that follow are the output: that on stdout, then that on stderr.
/// In it, "..." matches any text, and a line "..." any number of lines, but no line that begins
/// with "octetra: ". Seconds are not compared.
namespace octetra::test {

struct ConsoleStep {
    std::size_t line = 0;  ///< of its file, from 1
    int status = 0;
    std::string command;
    std::vector<std::string> printed{};
    bool is_compared = true;  ///< whether `printed` is all that the command prints
};

/// Adds a line of a console to the steps before it.
inline void take_console_line(std::vector<ConsoleStep>& steps, std::size_t number,
                              const std::string& line) {
    static const std::regex prompt(R"((\d*)\$ (.*))");
    std::smatch found;
    if (std::regex_match(line, found, prompt)) {
        const int status = found[1].length() == 0 ? 0 : std::stoi(found[1]);
        steps.push_back({number, status, found[2]});
    } else if (!steps.empty() && steps.back().printed.empty() && line.starts_with(">")) {
        steps.back().command += "\n" + line.substr(std::min<std::size_t>(2, line.size()));
    } else if (!steps.empty()) {
        steps.back().printed.push_back(line);
    }
}

inline std::string without_seconds(const std::string& line) {
    static const std::regex seconds(R"( *\d+\.\d+ s\b)");
    return std::regex_replace(line, seconds, " T s");
}

inline bool matches_line(const std::string& expected, const std::string& line) {
    const std::string text = without_seconds(line);
    const std::string pattern = without_seconds(expected);
    std::size_t at = 0;
    std::size_t begin = 0;
    for (std::size_t end = 0; end != std::string::npos; begin = end + 3) {
        end = pattern.find("...", begin);
        const std::string part = pattern.substr(begin, end - begin);
        const bool is_last = end == std::string::npos;
        if (begin == 0) {
            if (is_last) return text == pattern;
            if (!text.starts_with(part)) return false;
            at = part.size();
        } else if (is_last) {
            return text.size() >= at + part.size() && text.ends_with(part);
        } else {
            at = text.find(part, at);
            if (at == std::string::npos) return false;
            at += part.size();
        }
    }
    return true;
}

inline void expect_printed(const std::vector<std::string>& expected, const std::string& output) {
    std::vector<std::string> lines;
    std::istringstream in(output);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    auto next = lines.begin();
    bool some_left_out = false;
    const auto is_message = [](const std::string& line) { return line.starts_with("octetra: "); };
    for (const std::string& wanted : expected) {
        if (wanted == "...") {
            some_left_out = true;
            continue;
        }
        while (some_left_out && next != lines.end() && !matches_line(wanted, *next) &&
               !is_message(*next)) {
            ++next;
        }
        ASSERT_TRUE(next != lines.end()) << "not printed: " << wanted << "\nbut:\n" << output;
        ASSERT_TRUE(matches_line(wanted, *next))
            << "expected: " << wanted << "\nprinted:  " << *next << "\nin:\n"
            << output;
        ++next;
        some_left_out = false;
    }
    for (; next != lines.end(); ++next) {
        ASSERT_TRUE(some_left_out && !is_message(*next)) << "not expected: " << *next;
    }
}

/// Runs a command in a folder. Commands find the program octetra, `mpirun -n N`, which is
/// tests/support/mpirun.sh, `ranks N...`, which prints the numbers of ranks on which to repeat a
/// comparison (all of them if the environment has OCTETRA_EVERY_RANK_COUNT, otherwise the first),
/// and the folders $tests and $corpus.
inline Outcome run_step(const ConsoleStep& step, const std::filesystem::path& folder) {
    static const std::string preamble =
        "PATH='" + std::filesystem::path(OCTETRA_PROGRAM).parent_path().string() +
        "':$PATH\n"
        "export tests='" OCTETRA_SOURCE_DIR "/tests' corpus='" OCTETRA_SOURCE_DIR
        "/corpus'\n"
        "mpirun() { \"$tests/support/mpirun.sh\" \"${@:2}\"; }; export -f mpirun\n"
        "ranks() { [ -n \"${OCTETRA_EVERY_RANK_COUNT-}\" ] && echo \"$@\" || echo \"$1\"; }\n";
    return run_program({"/bin/bash", "-eo", "pipefail", "-c", preamble + step.command}, folder);
}

/// Runs the steps in a folder and stops at the first that does not do what it must.
inline void run_steps(const std::vector<ConsoleStep>& steps, const std::filesystem::path& folder,
                      const std::string& file) {
    for (const ConsoleStep& step : steps) {
        SCOPED_TRACE(file + ":" + std::to_string(step.line) + ": " + step.command);
        const Outcome run = run_step(step, folder);
        ASSERT_EQ(run.status, step.status) << run.out << run.err;
        EXPECT_EQ(("\n" + run.out).find("\noctetra: "), std::string::npos) << "a message on stdout";
        if (step.is_compared) expect_printed(step.printed, run.out + run.err);
        if (testing::Test::HasFailure()) return;
    }
}

}  // namespace octetra::test
