#include <algorithm>
#include <regex>
#include <string_view>

#include <gtest/gtest.h>

#include <octetra/generator/tetgen.hpp>

#include "docs/pages.hpp"
#include "support/run_program.hpp"

/// Runs the examples of README.md and docs/ and compares their output with the pages.
///
/// A block ```console contains commands after "$ ", each followed by its output, in which a line
/// "..." matches any number of lines. A block ```sh whose first line begins with "octetra "
/// contains only commands. The commands of a page run in one folder, in the order of the page;
/// `mpirun -n N` is replaced by tests/support/mpirun.sh.
namespace octetra::test {
namespace {

struct Example {
    std::size_t line = 0;  ///< of the block
    std::string command;
    std::vector<std::string> printed;
};

void take_console_line(std::vector<Example>& examples, std::size_t block, const std::string& line) {
    if (line.starts_with("$ ")) {
        examples.push_back({block, line.substr(2), {}});
    } else if (!examples.empty()) {
        examples.back().printed.push_back(line);
    }
}

std::vector<Example> examples_of(const std::string& page_name) {
    std::vector<Example> examples;
    for (const FencedBlock& block : page(page_name).blocks) {
        if (block.lines.empty()) continue;
        if (block.language == "console") {
            for (const std::string& line : block.lines) {
                take_console_line(examples, block.line, line);
            }
        } else if (block.language == "sh" && block.lines.front().starts_with("octetra ")) {
            for (const std::string& line : block.lines) examples.push_back({block.line, line, {}});
        }
    }
    return examples;
}

/// Replaces mpirun by the script that adds the options for containers and for machines with few
/// cores.
std::string runnable(const std::string& command) {
    constexpr std::string_view mpirun = "mpirun -n ";
    if (!command.starts_with(mpirun)) return command;
    std::string result = "'";
    result += (repository / "tests/support/mpirun.sh").string();
    result += "' ";
    result += command.substr(mpirun.size());
    return result;
}

/// Removes times and the widths of columns, which vary between runs and terminals.
std::string comparable(const std::string& line) {
    const std::string timeless = std::regex_replace(line, std::regex(R"(\d+\.\d+ s\b)"), "T s");
    std::string result;
    for (const std::string& word : words(timeless)) result += word + ' ';
    return result;
}

void expect_printed(const Example& example, const std::string& output) {
    std::vector<std::string> lines;
    std::istringstream in(output);
    for (std::string line; std::getline(in, line);) lines.push_back(comparable(line));

    auto next = lines.begin();
    bool some_left_out = false;
    for (const std::string& expected : example.printed) {
        if (expected == "...") {
            some_left_out = true;
            continue;
        }
        const auto found = std::find(next, lines.end(), comparable(expected));
        ASSERT_NE(found, lines.end()) << "not printed: " << expected << "\nbut:\n" << output;
        ASSERT_TRUE(found == next || some_left_out) << "lines before: " << expected;
        next = found + 1;
        some_left_out = false;
    }
    EXPECT_TRUE(next == lines.end() || some_left_out)
        << "lines after the last one shown: " << *next;
}

class Examples : public testing::TestWithParam<std::string> {};

TEST_P(Examples, WorkAndPrintWhatThePageSays) {
    if (!generator::has_tetgen()) GTEST_SKIP() << "the examples begin with a mesh by TetGen";
    const TemporaryFolder folder;
    const std::string path =
        "PATH=" + std::filesystem::path(OCTETRA_PROGRAM).parent_path().string() + ":$PATH\n";
    for (const Example& example : examples_of(GetParam())) {
        SCOPED_TRACE(GetParam() + ", block on line " + std::to_string(example.line) + ": " +
                     example.command);
        const Outcome run = run_program(
            {"/bin/sh", "-ec", "exec 2>&1\n" + path + runnable(example.command)}, folder.path());
        ASSERT_EQ(run.status, 0) << run.out;
        if (!example.printed.empty()) expect_printed(example, run.out);
    }
}

std::vector<std::string> pages_with_examples() {
    std::vector<std::string> names = user_pages();
    std::erase_if(names, [](const std::string& name) { return examples_of(name).empty(); });
    return names;
}

INSTANTIATE_TEST_SUITE_P(, Examples, testing::ValuesIn(pages_with_examples()),
                         [](const auto& test_case) { return name_of_test(test_case.param); });

TEST(Readme, HasAtLeastFiveExamples) { EXPECT_GE(examples_of("README.md").size(), 5U); }

}  // namespace
}  // namespace octetra::test
