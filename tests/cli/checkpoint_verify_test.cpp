#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/octetra_program.hpp"

/// --verify, --check and --maps where MESH or OUT is a mesh with its history.
namespace octetra {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

class CheckpointResults : public testing::Test {
protected:
    CheckpointResults() {
        run("generate two-material -o m.ele");
        run("refine m.ele --sphere 0,0,0,0.4 -o s.octetra");
        run("refine m.ele --sphere 0,0,0,0.4 -o s.ele");
        // Three cells at one face can be read and refined, but are not a valid mesh.
        (void)folder.write("three.node",
                           "6 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0 0 -1\n5 2 2 1\n");
        (void)folder.write("three.ele", "3 4 0\n0 0 1 2 3\n1 0 2 1 4\n2 0 1 2 5\n");
        run("refine three.ele --all --levels 2 -o three.octetra");
    }

    [[nodiscard]] test::Outcome outcome_of(const std::string& command, int ranks) const {
        return ranks == 0 ? test::octetra(command, folder)
                          : test::octetra_on(ranks, command, folder);
    }
    test::Outcome run(const std::string& arguments, int ranks = 0) const {
        auto outcome = outcome_of(arguments + " --quiet", ranks);
        EXPECT_EQ(outcome.status, 0) << arguments << "\n" << outcome.out << outcome.err;
        return outcome;
    }
    void expect_same(const std::string& a, const std::string& b) const {
        EXPECT_TRUE(test::content_of(folder / a) == test::content_of(folder / b)) << a << " " << b;
    }
    /// Checks that nothing is written and that stdout gives the reason.
    void expect_no(const std::string& command, int ranks, int status,
                   const std::string& why) const {
        SCOPED_TRACE(command);
        const auto outcome = outcome_of(command + " -o no.octetra", ranks);
        EXPECT_EQ(outcome.status, status) << outcome.err;
        EXPECT_THAT(outcome.out, HasSubstr("face_of_many_cells: "));
        EXPECT_EQ(test::occurrences(outcome.out, why), 1U) << outcome.out;
        EXPECT_FALSE(std::filesystem::exists(folder / "no.octetra"));
        EXPECT_FALSE(std::filesystem::exists(folder / "no.txt"));
    }

    const TemporaryFolder folder;
};

/// Refinement of a mesh with its history equals that of a file with the same cells.
TEST_F(CheckpointResults, OfRefinementHaveTheMapsOfTheMeshThatWasRead) {
    (void)folder.write("cells.txt", "0 7 3000");
    for (const std::string options :
         {"--random 0.01 --levels 2", "--cells cells.txt --region 2 --levels 2 --scheme 4t"}) {
        run("refine s.ele -o f.ele --maps f.txt " + options);
        run("refine m.ele -o g.ele --maps g.txt " + options);
        for (const int ranks : {0, 3}) {
            SCOPED_TRACE(testing::Message() << options << " on " << ranks);
            for (const auto& [files, maps] : std::vector<std::pair<std::string, std::string>>{
                     {"s.octetra -o h.octetra", "f.txt"},
                     {"s.octetra -o h.ele", "f.txt"},
                     {"m.ele -o h.octetra", "g.txt"}}) {
                run("refine " + files + " --maps h.txt --verify " + options, ranks);
                expect_same("h.txt", maps);
            }
        }
    }
    EXPECT_EQ(test::octetra("refine s.octetra --all -o x.octetra --maps x.ele", folder).err,
              "octetra: --maps: x.ele is the name of a mesh file; choose another\n");
}

TEST_F(CheckpointResults, OfRefinementAreVerifiedAgainstTheMeshThatWasRead) {
    run("refine s.octetra --sphere 0.1,0,0,0.3 --scheme 2t --levels 2 -o plain.octetra");
    for (const int ranks : {0, 3}) {
        SCOPED_TRACE(ranks);
        const std::string note =
            "note: of s.octetra itself, only orientation and faces were checked";
        const std::string good =
            "refine s.octetra --sphere 0.1,0,0,0.3 --scheme 2t --levels 2 -o g.octetra --verify";
        EXPECT_THAT(run(good, ranks).err, HasSubstr(note));
        expect_same("g.octetra", "plain.octetra");
        EXPECT_EQ(run(good + " --check", ranks).err, "");
        expect_no("refine three.octetra --sphere 0,0,0,0.3 --maps no.txt --verify", ranks, 1,
                  "no.octetra as a refinement of three.octetra: NOT VALID");
        expect_no("refine three.ele --all --verify", ranks, 1,
                  "no.octetra as a refinement of three.ele: NOT VALID");
        expect_no("refine three.octetra --all --check --maps no.txt", ranks, 2,
                  "three.octetra: NOT VALID");
        expect_no("refine three.ele --all --check", ranks, 2, "three.ele: NOT VALID");
    }
}

TEST_F(CheckpointResults, OfCoarseningAreVerifiedAgainstTheMeshThatWasRead) {
    (void)folder.write("cells.txt", "0 7 3000 3001");
    run("refine s.octetra --sphere 0.1,0,0,0.3 -o f.octetra");
    for (const int ranks : {0, 3}) {
        for (const std::string options :
             {"--outside --sphere 0.1,0,0,0.2 --levels 2", "--outside --cells cells.txt",
              "--region 2", "--all --levels 0"}) {
            SCOPED_TRACE(testing::Message() << options << " on " << ranks);
            run("coarsen f.octetra -o plain.octetra " + options);
            const auto judged = run("coarsen f.octetra -o c.octetra --verify " + options, ranks);
            EXPECT_THAT(judged.err, HasSubstr("note: of f.octetra itself, only orientation and"));
            expect_same("c.octetra", "plain.octetra");
        }
        expect_no("coarsen three.octetra --all --verify", ranks, 1,
                  "no.octetra as a coarsening of three.octetra: NOT VALID");
    }
}

}  // namespace
}  // namespace octetra
