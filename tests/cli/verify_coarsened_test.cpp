#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/octetra_program.hpp"

/// octetra verify --coarsened-from on the command line.
namespace octetra {
namespace {

using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;

class VerifyCoarsened : public testing::Test {
protected:
    VerifyCoarsened() {
        run(0, "generate two-material --edge 0.4 -o m.ele --quiet");
        run(0, "refine m.ele --sphere 0.5,0.5,0.5,0.4 --levels 2 -o fine.octetra --quiet");
    }
    test::Outcome run(int status, const std::string& arguments, int ranks = 1) const {
        test::Outcome outcome = ranks == 1 ? test::octetra(arguments, folder)
                                           : test::octetra_on(ranks, arguments, folder);
        EXPECT_EQ(outcome.status, status) << arguments << "\n" << outcome.out << outcome.err;
        return outcome;
    }
    void expect_refused(const std::string& arguments, const std::string& message) const {
        const test::Outcome outcome = run(2, "verify " + arguments);
        EXPECT_EQ(outcome.err, "octetra: " + message + "\n");
        EXPECT_EQ(outcome.out, "");
    }

    const TemporaryFolder folder;
};

TEST_F(VerifyCoarsened, AcceptsTheResultsOfCoarsen) {
    std::string numbers;
    for (int c = 1000; c < 9000; ++c) numbers += std::to_string(c) + " ";
    (void)folder.write("cells.txt", numbers);
    const std::vector<std::string> criteria{
        "--all",
        "--all --levels 2",
        "--outside --sphere 0.6,0.5,0.5,0.3",
        "--region 2 --box 0,0,0.6,1,1,1",
        "--random 0.9 --seed 3 --levels 2",
        "--cells cells.txt",
        "--outside --max-volume 1e-4 --levels 3",
    };
    std::size_t n = 0;
    for (const std::string& cells : criteria) {
        const std::string after =
            "after" + std::vector<std::string>{".octetra", ".ele", ".mesh"}[n++ % 3];
        run(0, "coarsen fine.octetra " + cells + " -o " + after + " --quiet", n % 2 == 0 ? 3 : 1);
        const auto judged = run(0, "verify " + after + " --coarsened-from fine.octetra " + cells);
        EXPECT_THAT(judged.out,
                    AllOf(HasSubstr("\nvertices that stay     passed "),
                          HasSubstr("\npieces                 passed "),
                          HasSubstr("\n" + after + " as a coarsening of fine.octetra: valid\n")));
        EXPECT_THAT(judged.out, testing::Not(HasSubstr("passed   0 of ")));  // some are gone
        EXPECT_EQ(judged.err, "");
    }
    // A mesh that was coarsened and refined again.
    run(0, "coarsen fine.octetra --outside --sphere 0.6,0.5,0.5,0.3 -o a.octetra --quiet");
    run(0, "refine a.octetra --sphere 0.6,0.7,0.5,0.2 -o b.octetra --quiet");
    run(0, "coarsen b.octetra --outside --region 2 -o c.octetra --quiet");
    EXPECT_THAT(run(0, "verify c.octetra --coarsened-from b.octetra --outside --region 2").out,
                testing::Not(HasSubstr("passed   0 of ")));
}

TEST_F(VerifyCoarsened, EndsWithStatus1WhereOtherCellsMightGo) {
    run(0, "coarsen fine.octetra --sphere 0.5,0.5,0.5,0.3 -o after.octetra --quiet");
    run(0, "convert after.octetra after.mesh --quiet");
    const std::string judge = "verify after.mesh --coarsened-from fine.octetra ";
    for (const int ranks : {1, 3}) {
        const auto more = run(1, judge + "--sphere 0.5,0.5,0.5,0.35", ranks);
        EXPECT_THAT(more.out, AllOf(HasSubstr("\nvertex_stayed: "), HasSubstr("previous vertex "),
                                    HasSubstr("; expected gone: all cells at it may be coarsened"),
                                    HasSubstr("NOT VALID\n")));
    }
    EXPECT_THAT(run(1, judge + "--sphere 0.5,0.5,0.5,0.25").out,
                AllOf(HasSubstr("\nvertex_went: "), HasSubstr("  previous vertex "),
                      HasSubstr("found gone; expected kept: it belongs to this cell, which must "
                                "not be coarsened")));
    run(1, judge + "--outside --sphere 0.5,0.5,0.5,0.3");
    run(1, judge + "--sphere 0.5,0.5,0.5,0.3 --levels 2");
    run(1, judge + "--sphere 0.5,0.5,0.5,0.3 --levels 0 --report r.json");
    const auto report = nlohmann::json::parse(test::content_of(folder / "r.json"));
    EXPECT_EQ(report["valid"], false);
    EXPECT_EQ(report["mesh"], "after.mesh");
    EXPECT_EQ(report["coarsened_from"], "fine.octetra");
    EXPECT_EQ(report["violations"][0]["code"], "vertex_went");
    EXPECT_EQ(report["violations"][0]["entities"][0]["mesh"], "before");
}

/// Vertices of the previous mesh are named as in their files: from 0 or from 1.
TEST_F(VerifyCoarsened, NamesVerticesAsTheirFilesDo) {
    run(0, "convert m.ele from1.mesh --quiet");
    const auto info = nlohmann::json::parse(run(0, "info m.ele --json").out);
    const std::uint64_t first_midpoint = info["counts"]["vertices"];
    for (const std::uint64_t base : {0U, 1U}) {
        const std::string input = base == 0 ? "m.ele" : "from1.mesh";
        run(0, "refine " + input + " --all -o f.octetra --quiet");
        const std::string judge = "verify " + input + " --coarsened-from f.octetra --all";
        run(0, judge);
        EXPECT_THAT(run(1, judge + " --levels 0 --report r.json").out,
                    HasSubstr("  previous vertex " + std::to_string(first_midpoint + base) +
                              ": found gone; expected kept: no level could remove it\n"));
        const auto report = nlohmann::json::parse(test::content_of(folder / "r.json"));
        EXPECT_EQ(report["violations"][0]["entities"][0]["number"], first_midpoint + base);
    }
}

TEST_F(VerifyCoarsened, AcceptsTheOptionsOfCoarsenAndNoOthers) {
    (void)folder.write("cells.txt", "1 2");
    const std::string from = " --coarsened-from fine.octetra";
    expect_refused("m.ele" + from,
                   "specify which cells to coarsen: --all, --cells, --sphere, --box, --region, "
                   "--random, --max-volume, --size, --near, --min-eta, --bulk, --fraction, "
                   "--above or --where");
    expect_refused("m.ele --coarsened-from m.ele --all",
                   "--coarsened-from: m.ele has no history: it takes a .octetra file, as octetra "
                   "coarsen does");
    expect_refused("m.ele m.ele --all" + from,
                   "verify: --coarsened-from takes one mesh, the coarsened one, not two");
    expect_refused("m.ele --all --scheme 8t" + from,
                   "verify: --scheme applies to refinement, not to coarsening");
    expect_refused("m.ele --all --maps maps.txt" + from,
                   "verify: --maps can be checked only with COARSE and REFINED");
    expect_refused("m.ele m.ele --all --outside", "verify: --outside requires --coarsened-from");
    expect_refused("m.ele --cells cells.txt --levels 2" + from,
                   "--cells refers to the cells of one mesh, but --levels also coarsens later "
                   "ones; give only one of the two");
    (void)folder.write("cells.txt", "99999999");
    EXPECT_THAT(run(2, "verify m.ele --cells cells.txt" + from).err,
                HasSubstr("octetra: cells.txt"));
    (void)folder.write("bad.octetra", "no checkpoint");
    for (const int ranks : {1, 3}) {
        EXPECT_THAT(run(2, "verify m.ele --coarsened-from bad.octetra --all", ranks).err,
                    HasSubstr("octetra: bad.octetra: "));
    }
}

}  // namespace
}  // namespace octetra
