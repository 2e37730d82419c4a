#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/octetra_program.hpp"
#include "support/manifest.hpp"

/// octetra verify and refine --verify under mpirun give the verdict of one process.
namespace octetra {
namespace {

using test::occurrences;
using test::octetra_on;
using test::TemporaryFolder;
using testing::HasSubstr;

class VerifyParallel : public testing::Test {
protected:
    VerifyParallel() {
        EXPECT_EQ(test::octetra("generate gear -o gear.1.ele --quiet", folder).status, 0);
        EXPECT_EQ(
            test::octetra(
                "refine gear.1.ele" + selection + " -o fine.1.ele --maps fine.maps --quiet", folder)
                .status,
            0);
    }

    /// The report without the entries that depend on the number of processes.
    [[nodiscard]] nlohmann::json report() const {
        auto report = nlohmann::json::parse(test::content_of(folder / "r.json"));
        report.erase("arithmetic");
        for (auto& check : report["checks"]) check.erase("seconds");
        return report;
    }
    /// The output without the count of decisions by kind of arithmetic.
    static std::string without_decisions(const std::string& out) {
        std::istringstream lines(out);
        std::string kept;
        for (std::string line; std::getline(lines, line);) {
            if (line.find("decisions by") == std::string::npos) kept += line + "\n";
        }
        return kept;
    }
    void expect_same(const std::string& arguments, int status,
                     const std::vector<int>& sizes = test::rank_counts({3, 2, 4})) const {
        SCOPED_TRACE(arguments);
        const auto alone = test::octetra("verify " + arguments + " --report r.json", folder);
        ASSERT_EQ(alone.status, status) << alone.out << alone.err;
        const auto report_alone = report();
        for (const int ranks : sizes) {
            SCOPED_TRACE(ranks);
            const auto run = octetra_on(ranks, "verify " + arguments + " --report r.json", folder);
            EXPECT_EQ(run.status, status) << run.err;
            EXPECT_EQ(without_decisions(run.out), without_decisions(alone.out));
            EXPECT_EQ(report(), report_alone);
        }
    }

    const TemporaryFolder folder;
    const std::string selection = " --sphere 1,0,0.15,0.4 --levels 2";
};

TEST_F(VerifyParallel, GivesTheVerdictOfOneProcessOnAValidMesh) {
    expect_same("gear.1.ele --min-dihedral 5", 0);
    expect_same("gear.1.ele fine.1.ele --maps fine.maps" + selection, 0,
                test::rank_counts({3, 1, 2, 4, 7}));
    expect_same("gear.1.ele fine.1.ele --fast", 0);
}

TEST_F(VerifyParallel, GivesTheVerdictOfOneProcessOnABrokenMesh) {
    expect_same("gear.1.ele fine.1.ele --all", 1);
    expect_same("fine.1.ele gear.1.ele", 1);
    expect_same("gear.1.ele --min-dihedral 30", 1);
    const std::string bad = (test::corpus_folder() / "bad").string() + "/";
    expect_same(bad + "medit-inverted-cell.mesh", 1);
    expect_same(bad + "flat-cell.ele", 1);
}

TEST_F(VerifyParallel, TakesAListOfCells) {
    (void)folder.write("cells.txt", "3\n70\n");
    ASSERT_EQ(test::octetra("refine gear.1.ele --cells cells.txt -o by_list.1.ele --quiet", folder)
                  .status,
              0);
    expect_same("gear.1.ele by_list.1.ele --cells cells.txt", 0);
    (void)folder.write("others.txt", "4\n");
    expect_same("gear.1.ele by_list.1.ele --cells others.txt", 1);
}

TEST_F(VerifyParallel, PassesOverAttributesThatTheFormatCannotHoldAndNoOthers) {
    (void)folder.write("one.node", "4 3 1 0\n0 0 0 0 5\n1 1 0 0 6\n2 0 1 0 7\n3 0 0 1 8\n");
    (void)folder.write("one.ele", "1 4 0\n0 0 1 2 3\n");
    for (const std::string output : {"fine.mesh", "fine.ele"}) {
        const auto run = test::octetra("refine one.ele --all --quiet -o " + output, folder);
        ASSERT_EQ(run.status, 0) << run.err;
    }
    expect_same("one.ele fine.mesh", 0);
    (void)folder.write("less.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    (void)folder.write("less.ele", "1 4 0\n0 0 1 2 3\n");
    expect_same("one.ele less.ele", 1);
}

TEST_F(VerifyParallel, EndsInOneMessageWhereAFileCannotBeRead) {
    (void)folder.write("bad.mesh", "MeshVersionFormatted 2 Dimension 3\nVertices 1\n0 0\n");
    for (const std::string arguments :
         {"verify bad.mesh", "verify gear.1.ele bad.mesh",
          "verify gear.1.ele fine.1.ele --maps bad.mesh", "verify gear.1.ele fine.1.ele --region 3",
          "verify gear.1.ele --report no/r.json"}) {
        const auto alone = test::octetra(arguments, folder);
        const auto run = octetra_on(3, arguments, folder);
        EXPECT_EQ(run.status, 2) << run.err;
        EXPECT_THAT(run.err, HasSubstr(alone.err));
        EXPECT_EQ(occurrences(run.err, "octetra: "), 1U) << run.err;
    }
}

TEST_F(VerifyParallel, OfRefineJudgesBeforeItWrites) {
    const std::string refine = "refine gear.1.ele" + selection + " --verify -o p.1.ele";
    for (const std::string maps : {"", " --maps p.maps"}) {
        const auto run = octetra_on(3, refine + maps, folder);
        EXPECT_EQ(run.status, 0) << run.out << run.err;
        EXPECT_EQ(occurrences(run.out, "verified"), 1U) << run.out;
        EXPECT_EQ(test::content_of(folder / "p.1.ele"), test::content_of(folder / "fine.1.ele"));
    }
    EXPECT_EQ(test::content_of(folder / "p.maps"), test::content_of(folder / "fine.maps"));
}

}  // namespace
}  // namespace octetra
