#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/octetra_program.hpp"

namespace octetra {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;
using testing::StartsWith;

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

TEST(ExitStatus, IsExplainedWhereItHasMoreThanTwoMeanings) {
    const TemporaryFolder folder;
    for (const std::string command : {"", "refine", "adapt", "verify"}) {
        const std::string help = test::octetra(command + " --help", folder).out;
        EXPECT_THAT(help, HasSubstr("3 the system failed")) << command;
        EXPECT_THAT(help, HasSubstr("128 + its number")) << command;
        EXPECT_THAT(help, testing::Not(HasSubstr("lost rank"))) << command;
    }
}

INSTANTIATE_TEST_SUITE_P(Subcommands, Help,
                         testing::Values("", "refine", "adapt", "coarsen", "info", "convert",
                                         "partition", "verify", "compare", "generate",
                                         "generate kuhn", "generate bcc", "generate regular",
                                         "generate random", "generate slivers", "generate sphere",
                                         "generate fichera", "generate torus", "generate gear",
                                         "generate two-material"));

class BadUsage : public testing::TestWithParam<std::string> {};

TEST_P(BadUsage, EndsInStatus2AndOneMessageAndWritesNothing) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate kuhn 1 -o cube.ele", folder).status, 0);
    const test::Outcome run = test::octetra(GetParam(), folder);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, StartsWith("octetra: "));
    EXPECT_EQ(test::occurrences(run.err, "\n"), 1U) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out.ele"));
}

INSTANTIATE_TEST_SUITE_P(
    CommandLines, BadUsage,
    testing::Values(
        "", "nonsense", "refine", "refine cube.ele", "refine cube.ele -o out.ele",
        "refine cube.ele --all", "refine missing.ele --all -o out.ele",
        "refine cube.ele --all -o out.stl", "refine cube.ele --all -o no/out.ele",
        "refine cube.ele --all --scheme 3t -o out.ele",
        "refine cube.ele --all --levels -1 -o out.ele",
        "refine cube.ele --all --levels x -o out.ele", "refine cube.ele --sphere 0,0,0 -o out.ele",
        "refine cube.ele --sphere 0,0,0,nan -o out.ele",
        "refine cube.ele --sphere 0,0,0,-1 -o out.ele",
        "refine cube.ele --sphere 0,0,0,1, -o out.ele",
        "refine cube.ele --sphere +-1,0,0,1 -o out.ele",
        "refine cube.ele --sphere 0,,0,1 -o out.ele",
        "refine cube.ele --sphere 0,0,0,inf -o out.ele", "refine cube.ele --sphere= -o out.ele",
        "refine cube.ele --random .5 --seed -1 -o out.ele",
        "refine cube.ele --all --seed 1 -o out.ele",
        "refine cube.ele --all --max-cells 0 -o out.ele",
        "refine cube.ele --all --max-cells -1 -o out.ele",
        "refine cube.ele --box 0,0,0,1,1 -o out.ele",
        "refine cube.ele --box 1,0,0,0,1,1 -o out.ele", "refine cube.ele --random 1.5 -o out.ele",
        "refine cube.ele --random nan -o out.ele", "refine cube.ele --max-volume -1 -o out.ele",
        "refine cube.ele --region 1 -o out.ele", "refine cube.ele --cells missing.txt -o out.ele",
        "refine cube.ele --all -o out.ele --maps out.ele",
        "refine cube.ele --all -o out.ele --maps cube.node",
        "refine cube.ele --all -o out.ele --maps no/maps.txt",
        "refine cube.ele --all -o out.ele --maps /dev/null",
        "refine cube.ele extra.ele --all -o out.ele", "info", "info missing.mesh",
        "adapt cube.ele -o out.ele", "adapt cube.ele --script cube.node -o out.ele",
        "adapt cube.ele --script missing.txt -o out.ele", "adapt cube.ele --script cube.ele",
        "convert cube.ele", "verify", "verify cube.ele --all", "verify cube.ele --maps cube.ele",
        "verify cube.ele cube.ele --min-dihedral 181", "verify missing.ele",
        "verify cube.ele --report cube.ele", "verify cube.ele --fast --min-dihedral 3",
        "compare cube.ele", "partition cube.ele", "partition cube.ele -n 0",
        "partition cube.ele -n 2 --partition metis", "partition missing.ele -n 2",
        "partition cube.ele -n 2 -o out.ele", "partition cube.ele -n 2 -o no/parts.txt",
        "partition cube.ele -n 2 --levels 3", "partition cube.ele -n 2 --sphere 1,2,3",
        "partition cube.ele -n 2 --region 7", "partition cube.ele -n 2 --cells missing.txt",
        "refine cube.ele --all --partition x -o out.ele",
        "refine cube.ele --all --sync x -o out.ele", "refine cube.ele --all --scheme 0 -o out.ele",
        "convert cube.ele out.obj", "generate", "generate cube", "generate kuhn 0 -o out.ele",
        "generate kuhn 1 2 -o out.ele", "generate kuhn 99999999999 -o out.ele", "generate kuhn 2",
        "generate gear --bore 5 -o out.ele", "generate sphere --edge 0 -o out.ele",
        "generate random 3 -o out.ele", "generate random 9 --seed -1 -o out.ele"));

/// The message contains the unknown word and the existing subcommands.
TEST(BadUsage, NamesTheWordThatIsNoSubcommand) {
    const TemporaryFolder folder;
    EXPECT_THAT(
        test::octetra("frobnicate gear.1.ele -o x.ele", folder).err,
        StartsWith(
            "octetra: 'frobnicate' is not one of refine, adapt, coarsen, info, generate, convert, "
            "partition, verify, compare; see octetra --help\n"));
    EXPECT_THAT(test::octetra("generate sphear -o x.ele", folder).err,
                StartsWith("octetra: generate takes one of kuhn, bcc, regular, random, slivers, "
                           "sphere, fichera, torus, gear, two-material, not 'sphear'; did you "
                           "mean sphere? See octetra generate --help\n"));
    EXPECT_THAT(test::octetra("--frobnicate", folder).err,
                StartsWith("octetra: there is no option --frobnicate; see octetra --help\n"));
    EXPECT_THAT(test::octetra("", folder).err, HasSubstr("A subcommand is required"));
}

/// The message contains the first unexpected word and a suggestion.
TEST(BadUsage, NamesTheWordThatIsNotExpected) {
    const TemporaryFolder folder;
    const auto said = [&](const std::string& words) {
        return test::octetra("refine a.ele --all -o x.ele " + words, folder).err;
    };
    const std::string see_help = "; see octetra refine --help\n";
    EXPECT_EQ(said("--frobnicate 1"), "octetra: refine has no option --frobnicate" + see_help);
    for (const char* words : {"--shpere 1,0,0,1", "-sphere 1,0,0,1", "--spere=1,0,0,1"}) {
        EXPECT_THAT(said(words),
                    testing::EndsWith("; did you mean --sphere? See octetra refine --help\n"));
    }
    EXPECT_EQ(said("b.ele"), "octetra: refine does not expect 'b.ele'" + see_help);
    for (const char* words :
         {"--sphere 1 0 0 .4", "--sphere -1 0 0 .4", "--sphere 1, 0 0 .4", "--sphere 1,1,1,1 0"}) {
        EXPECT_THAT(said(words), StartsWith("octetra: refine does not expect '0'; the values of an "
                                            "option are one word with commas, as in --sphere "
                                            "X,Y,Z,R; see octetra refine --help\n"))
            << words;
    }
    EXPECT_THAT(test::octetra("info a.ele 3", folder).err,
                StartsWith("octetra: info does not expect '3'; see octetra info --help\n"));
}

TEST(Version, IsPrinted) {
    const TemporaryFolder folder;
    EXPECT_THAT(test::octetra("--version", folder).out, StartsWith("octetra "));
}

}  // namespace
}  // namespace octetra
