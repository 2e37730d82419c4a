#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/run_program.hpp"

/// What ./dev and mpirun.sh say before anything is installed or built.
namespace octetra {
namespace {

using testing::HasSubstr;
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
    testing::Values("frobnicate", "build --fast", "build relaese", "test --slow", "test A B",
                    "fuzz --minutes", "fuzz --minutes 0", "fuzz --minutes 00", "fuzz --minutes x",
                    "fuzz 5", "worlds --minutes 0", "worlds --from 0", "worlds --from 262",
                    "shrink", "shrink a.ele", "shrink no-such-file.json", "shrink a.json b.json",
                    "shrink a.json --minutes 0", "shrink a.json --ranks 0", "shrink a.json --ranks",
                    "shrink --slow 1 a.json", "fuzz-files --minutes 0", "format --slow"));

/// Without installing anything: that comes before the list of mutants is read.
TEST(Mutants, TakeNoTimeThatIsOverAtOnce) {
    const test::TemporaryFolder folder;
    for (const std::string minutes : {"0", "-1", "nan"}) {
        const auto run = test::run_program(
            {"python3", sources + "/tests/mutants/run.py", "--minutes=" + minutes}, folder.path());
        EXPECT_EQ(run.status, 2) << minutes;
        EXPECT_THAT(run.err, HasSubstr("greater than 0")) << minutes;
    }
}

/// A rank looks for a terminal to colour, and mpirun gives it one.
TEST(Mpirun, LetsNoTestPrintColoursIntoAFile) {
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
