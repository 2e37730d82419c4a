#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/run_program.hpp"

/// The output of ./dev and mpirun.sh before anything is installed or built.
namespace octetra {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string sources = OCTETRA_SOURCE_DIR;

class BadUsage : public testing::TestWithParam<std::string> {};

TEST_P(BadUsage, EndsInStatus2AndOneMessage) {
    const test::TemporaryFolder folder;
    const auto run = test::run_program(test::words(sources + "/dev " + GetParam()), folder.path());
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, StartsWith("dev: "));
}

INSTANTIATE_TEST_SUITE_P(
    CommandLines, BadUsage,
    testing::Values("frobnicate", "build --fast", "build relaese", "test --slow",
                    "test --quick --sanitized", "test A B", "campaign frobnicate",
                    "campaign frobnicate --help", "campaign --minutes 9", "campaign fuzz --minutes",
                    "campaign fuzz --minutes 0", "campaign fuzz --minutes 00",
                    "campaign fuzz --minutes x", "campaign fuzz 5", "campaign worlds --minutes 0",
                    "campaign worlds --from 0", "campaign worlds --from 270", "campaign shrink",
                    "campaign shrink a.ele", "campaign shrink no-such-file.json",
                    "campaign shrink a.json b.json", "campaign shrink a.json --minutes 0",
                    "campaign shrink a.json --ranks 0", "campaign shrink a.json --ranks",
                    "campaign shrink --slow 1 a.json", "campaign files --minutes 0",
                    "campaign packages --minutes 0", "campaign packages now",
                    "campaign platforms --only debian-3", "campaign platforms --folder",
                    "format --slow", "docs now", "clean all"));

/// Help neither installs nor builds the prerequisites of a verb.
class Help : public testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(Help, IsOfTheVerbThatIsAskedFor) {
    const auto& [words, line] = GetParam();
    const test::TemporaryFolder folder;
    const auto run = test::run_program(test::words(sources + "/dev " + words), folder.path());
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.out, StartsWith("usage: "));
    EXPECT_THAT(run.out, HasSubstr(line));
    EXPECT_THAT(run.out, Not(HasSubstr("  demo  ")));
}

INSTANTIATE_TEST_SUITE_P(
    CommandLines, Help,
    testing::Values(std::pair("test --help", "  test [--quick"),
                    std::pair("test Closure --help", "  test [--quick"),
                    std::pair("build -h", "  build [PRESET]"),
                    std::pair("campaign --help", "    fuzz [--seed S]"),
                    std::pair("campaign fuzz -h", "  campaign fuzz [--seed S]"),
                    std::pair("campaign faults --moments 2 --help",
                              "  campaign faults [--moments N]"),
                    std::pair("bench --help", "usage: ./dev bench [-h]"),
                    std::pair("bench --rival --help", "--rival [--quick]"),
                    std::pair("bench --quick --paper -h", "--paper [--quick]"),
                    std::pair("equivalence --help", "usage: ./dev equivalence [-h]")));

/// The arguments are checked before anything is installed and before the list of mutants is read.
TEST(Mutants, RefuseATimeLimitThatIsNotPositive) {
    const test::TemporaryFolder folder;
    for (const std::string minutes : {"0", "-1", "nan"}) {
        const auto run = test::run_program(
            {"python3", sources + "/tests/mutants/run.py", "--minutes=" + minutes}, folder.path());
        EXPECT_EQ(run.status, 2) << minutes;
        EXPECT_THAT(run.err, HasSubstr("greater than 0")) << minutes;
    }
}

/// A rank colours its output if it has a terminal, and mpirun gives it one.
TEST(Mpirun, PrintsNoColoursIntoAFile) {
    const test::TemporaryFolder folder;
    const auto mpirun = sources + "/tests/support/mpirun.sh";
    const auto run = test::run_program(
        {mpirun, "1", OCTETRA_THIS_PROGRAM, "--gtest_filter=*/BadUsage.*/0"}, folder.path());
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("[  PASSED  ]"));
    EXPECT_EQ(run.out.find('\x1b'), run.out.npos) << run.out;
}

}  // namespace
}  // namespace octetra
