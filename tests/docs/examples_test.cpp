#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/generator/tetgen.hpp>

#include "docs/pages.hpp"
#include "support/console.hpp"
#include "support/temporary_folder.hpp"

/// Runs the examples of README.md and docs/ and compares their output with the pages.
///
/// A block ```console contains commands and their output; see support/console.hpp. A block ```sh
/// whose first line begins with "octetra " contains only commands. The commands of a page run in
/// one folder, in the order of the page.
namespace octetra::test {
namespace {

std::vector<ConsoleStep> examples_of(const std::string& page_name) {
    std::vector<ConsoleStep> examples;
    for (const FencedBlock& block : page(page_name).blocks) {
        if (block.lines.empty()) continue;
        if (block.language == "console") {
            for (const std::string& line : block.lines) {
                take_console_line(examples, block.line, line);
            }
        } else if (block.language == "sh" && block.lines.front().starts_with("octetra ")) {
            for (const std::string& line : block.lines)
                examples.push_back({block.line, 0, line, {}, false});
        }
    }
    return examples;
}

class Examples : public testing::TestWithParam<std::string> {};

TEST_P(Examples, WorkAndPrintWhatThePageSays) {
    if (!generator::has_tetgen()) GTEST_SKIP() << "the examples begin with a mesh by TetGen";
    const TemporaryFolder folder;
    run_steps(examples_of(GetParam()), folder.path(), GetParam());
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
