#include <sstream>

#include <gtest/gtest.h>

#include "cli/octetra_program.hpp"

namespace octetra {
namespace {

using test::TemporaryFolder;

std::vector<std::string> examples_in(const std::string& help) {
    std::vector<std::string> commands;
    std::istringstream lines(help.substr(help.find("Example:")));
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("  octetra ") || line.starts_with("  echo "))
            commands.push_back(line.substr(2));
        else if (!line.starts_with("  mpirun ") && line != "Example:" && !line.empty()) {
            ADD_FAILURE() << "not to be pasted: " << line;
        }
    }
    return commands;
}

class Help : public testing::TestWithParam<std::string> {};

TEST_P(Help, ShowsAnExampleThatWorksWhenPasted) {
    const TemporaryFolder folder;
    const test::Outcome help = test::octetra(GetParam() + " --help", folder);
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.err, "");
    const auto examples = examples_in(help.out);
    EXPECT_FALSE(examples.empty());
    for (const std::string& example : examples) {
        const bool is_ours = example.starts_with("octetra ");
        const test::Outcome run =
            is_ours ? test::octetra(example.substr(8), folder)
                    : test::run_program({"/bin/sh", "-c", example}, folder.path());
        EXPECT_EQ(run.status, 0) << example << "\n" << run.err;
        EXPECT_EQ(run.out.empty(), !is_ours) << example;
    }
}

TEST_P(Help, FitsATerminal) {
    const TemporaryFolder folder;
    std::istringstream lines(test::octetra(GetParam() + " --help", folder).out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120U) << line;
}

INSTANTIATE_TEST_SUITE_P(Subcommands, Help,
                         testing::Values("", "refine", "adapt", "coarsen", "info", "convert",
                                         "partition", "verify", "certify", "compare", "generate",
                                         "generate kuhn", "generate bcc", "generate regular",
                                         "generate random", "generate slivers", "generate sphere",
                                         "generate fichera", "generate torus", "generate gear",
                                         "generate two-material"));

}  // namespace
}  // namespace octetra
