#include <sstream>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/octetra_program.hpp"

/// octetra refine --check: the input is verified before it is refined.
namespace octetra {
namespace {

using test::octetra_on;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

/// A mesh that can be read, and the fault that verify reports.
struct Fault {
    std::string what;
    std::string node;
    std::string ele;
};

const std::vector<Fault> faults{
    {"face_of_many_cells: 1", "6 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 0 0 -1\n6 2 2 1\n",
     "3 4\n1 1 2 3 4\n2 1 3 2 5\n3 1 2 3 6\n"},
    {"cells_on_one_side: 1", "5 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 2 2 1\n",
     "2 4\n1 1 2 3 4\n2 1 2 3 5\n"},
    {"vertex_in_cell: 1",
     "8 3\n1 0 0 0\n2 4 0 0\n3 0 4 0\n4 0 0 4\n5 1 1 1\n6 9 1 1\n7 1 9 1\n8 1 1 9\n",
     "2 4\n1 1 2 3 4\n2 5 6 7 8\n"},
    {"hanging_vertex: 1",
     "8 3\n1 0 0 0\n2 4 0 0\n3 0 4 0\n4 0 0 4\n5 2 0 0\n6 2 -1 0\n7 3 -1 -1\n8 3 -1 0\n",
     "2 4\n1 1 2 3 4\n2 5 6 7 8\n"},
    {"boundary_crosses",
     "8 3\n1 0 0 0\n2 4 0 0\n3 0 4 0\n4 0 0 4\n5 1 1 -1\n6 1 1 9\n7 9 2 9\n8 9 1 9\n",
     "2 4\n1 1 2 3 4\n2 5 6 8 7\n"},
};

class Check : public testing::Test {
protected:
    void write(const Fault& fault) const {
        (void)folder.write("in.node", fault.node);
        (void)folder.write("in.ele", fault.ele);
    }
    void expect_nothing_written() const {
        EXPECT_FALSE(std::filesystem::exists(folder / "out.ele"));
        EXPECT_FALSE(std::filesystem::exists(folder / "out.node"));
    }
    /// The output without the count of decisions by kind of arithmetic and without the line "read".
    static std::string verdict(const std::string& out) {
        std::istringstream lines(out);
        std::string kept;
        for (std::string line; std::getline(lines, line);) {
            if (line.find("decisions by") == std::string::npos && !line.starts_with("read ")) {
                kept += line + "\n";
            }
        }
        return kept;
    }

    const TemporaryFolder folder;
    const std::string refine = "refine in.ele --all -o out.ele";
};

TEST_F(Check, RefusesFaultsThatReadingDoesNotDetectWithTheVerdictOfVerify) {
    for (const Fault& fault : faults) {
        SCOPED_TRACE(fault.what + "\n" + fault.node);
        write(fault);
        const auto judged = test::octetra("verify in.ele", folder);
        EXPECT_THAT(judged.out, HasSubstr(fault.what));
        for (const std::string engine : {"", " --engine reference"}) {
            const auto refused = test::octetra(refine + " --check" + engine, folder);
            EXPECT_EQ(refused.status, 2);
            EXPECT_EQ(verdict(refused.out), verdict(judged.out));
            EXPECT_EQ(refused.err,
                      "octetra: in.ele: --check finds the mesh not valid; nothing was written\n");
            expect_nothing_written();
        }
        const auto unchecked = test::octetra(refine, folder);
        EXPECT_EQ(unchecked.status, 0) << unchecked.err;
        std::filesystem::remove(folder / "out.ele");
        std::filesystem::remove(folder / "out.node");
    }
}

TEST_F(Check, GivesTheSameVerdictOnSeveralRanks) {
    for (const Fault& fault : faults) {
        SCOPED_TRACE(fault.what + "\n" + fault.node);
        write(fault);
        const auto alone = test::octetra(refine + " --check", folder);
        const auto run = octetra_on(3, refine + " --check", folder);
        EXPECT_EQ(run.status, 2);
        EXPECT_EQ(verdict(run.out), verdict(alone.out));
        EXPECT_THAT(run.err, HasSubstr(alone.err));
        EXPECT_EQ(test::occurrences(run.err, "octetra: "), 1U) << run.err;
        expect_nothing_written();
    }
}

TEST_F(Check, OfAValidMeshChangesNothing) {
    ASSERT_EQ(test::octetra("generate gear -o in.ele --quiet", folder).status, 0);
    ASSERT_EQ(test::octetra("refine in.ele --all -o unchecked.ele --quiet", folder).status, 0);
    const std::string expected = test::content_of(folder / "unchecked.ele");
    for (const int ranks : {1, 3}) {
        const auto run = octetra_on(ranks, refine + " --check --verify", folder);
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(test::occurrences(run.out, "checked in.ele"), 1U) << run.out;
        EXPECT_THAT(run.err, Not(HasSubstr("whether cells overlap")));
        EXPECT_EQ(test::content_of(folder / "out.ele"), expected);
    }
    EXPECT_EQ(test::octetra(refine + " --check --quiet", folder).out, "");
}

TEST_F(Check, ChecksCellsAfterTheirOrientationIsCorrected) {
    write({"", "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n", "1 4\n0 1 0 2 3\n"});
    EXPECT_EQ(test::octetra(refine + " --check", folder).status, 2);
    EXPECT_EQ(test::octetra(refine + " --check --fix-orientation", folder).status, 0);
}

}  // namespace
}  // namespace octetra
