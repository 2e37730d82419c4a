#include <algorithm>
#include <chrono>

#include <gtest/gtest.h>

#include <octetra/generator/lattices.hpp>

#include "properties/case_files.hpp"
#include "properties/one_level.hpp"
#include "support/run_program.hpp"

/// Shrinking of cases that end or block the process that judges them, with faulty laws
/// (faulty_laws.cpp) whose smallest case is known.
namespace octetra::properties {
namespace {

namespace fs = std::filesystem;

/// 6 cells, most of them marked; the given rank has some.
Case some_case(int rank = 1) {
    Case c{.kind = "a lattice", .mesh = generator::kuhn(1, 1, 1, {1, 1, 1}), .levels = 2};
    c.mesh.regions.assign(c.mesh.cells.size(), Marker{5});
    c.selection.random = RandomShare{0.8, 1};
    for (std::size_t i = 0; i < c.mesh.cells.size(); ++i) {
        c.cell_to_rank.push_back(i % 3 == 2 ? rank : 0);
    }
    return c;
}

class Shrinking : public testing::Test {
protected:
    fs::path write(const std::string& law, const std::string& name) const {
        return write({law, "seen", some_case(), 2}, name);
    }
    fs::path write(const Finding& finding, const std::string& name) const {
        return write_finding(finding, folder_.path(), name);
    }
    test::Outcome shrink(const std::vector<std::string>& arguments) const {
        std::vector<std::string> command{"env", "OCTETRA_CPU_SECONDS=1", OCTETRA_SHRINK_FINDING};
        command.insert(command.end(), arguments.begin(), arguments.end());
        return test::run_program(command, folder_.path());
    }
    /// The only file of the folder.
    [[nodiscard]] fs::path kept_file() const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(folder_.path())) {
            if (entry.path().extension() == ".json") files.push_back(entry.path());
        }
        EXPECT_EQ(files.size(), 1U);
        return files.empty() ? fs::path() : files.front();
    }
    [[nodiscard]] Finding kept() const { return read_finding(kept_file()); }

private:
    test::TemporaryFolder folder_;
};

/// The same condition as in faulty_laws.cpp, on two ranks.
bool is_faulty(const Case& c) {
    std::size_t marked = 0;
    for (CellIndex i{0}; i < c.mesh.cells.end_index(); ++i) marked += is_marked(c, i) ? 1U : 0U;
    return marked > 3 && std::ranges::max(c.cell_to_rank) > 0;
}

void expect_smallest(const Case& c) {
    EXPECT_EQ(c.mesh.cells.size(), 4U);
    EXPECT_EQ(c.selection.cells.size(), 4U);
    EXPECT_FALSE(c.selection.random);
    EXPECT_EQ(c.levels, 1);
    EXPECT_TRUE(c.mesh.regions.empty() && c.mesh.facets.empty());
    EXPECT_EQ(std::ranges::count(c.cell_to_rank, 0), 3);
    EXPECT_EQ(std::ranges::count(c.cell_to_rank, 1), 1);
}

TEST_F(Shrinking, OfACaseThatAbortsEndsAtTheSmallestThatDoes) {
    const auto file = write("equality", "equality-running-17");
    const auto [status, out, err] = shrink({file, "0", "200", OCTETRA_FAULTY_LAWS});
    EXPECT_EQ(status, 0) << out << err;
    expect_smallest(kept().refinement);
    EXPECT_EQ(kept().law, "equality");
    EXPECT_EQ(kept().ranks, 2);
    EXPECT_FALSE(is_running_name(kept_file().stem()));
    const std::string line = "\nreplay: OCTETRA_FINDING=" + kept_file().string() + " ";
    EXPECT_NE(out.find(line), out.npos) << out;
}

TEST_F(Shrinking, OfACaseThatWaitsForEverEndsAtTheSmallestThatDoes) {
    const auto file = write("numbering", "numbering-running-17");
    const auto [status, out, err] = shrink({file, "0", "250", OCTETRA_FAULTY_LAWS});
    EXPECT_EQ(status, 0) << out << err;
    expect_smallest(kept().refinement);
}

TEST_F(Shrinking, TakesFewerRanksBeforeItTakesFewerCells) {
    const auto file = write({"closure", "seen", some_case(), 4}, "some");
    const auto [status, out, err] = shrink({file, "0", "200", OCTETRA_FAULTY_LAWS});
    EXPECT_EQ(status, 0) << out << err;
    EXPECT_LT(out.find("on 2 ranks, too"), out.find("\n4 cells")) << out;
    EXPECT_EQ(kept().ranks, 2);
    expect_smallest(kept().refinement);
}

/// On two ranks the first one has all cells, until they are assigned to rank 1.
TEST_F(Shrinking, TakesFewerRanksOnceFewerCellsAllowIt) {
    const auto file = write({"closure", "seen", some_case(2), 3}, "some");
    const auto [status, out, err] = shrink({file, "0", "200", OCTETRA_FAULTY_LAWS});
    EXPECT_EQ(status, 0) << out << err;
    EXPECT_EQ(kept().ranks, 2);
    expect_smallest(kept().refinement);
}

TEST_F(Shrinking, OfACaseThatEndsWithoutAVerdictContinuesDespiteStatusZero) {
    const auto [status, out, err] =
        shrink({write("files", "files-running-17"), "0", "200", OCTETRA_FAULTY_LAWS});
    EXPECT_EQ(status, 0) << out << err;
    expect_smallest(kept().refinement);
}

TEST_F(Shrinking, OfACaseThatBreaksItsLawEndsAtTheSmallestThatDoes) {
    const auto [status, out, err] =
        shrink({write("closure", "some"), "0", "200", OCTETRA_FAULTY_LAWS});
    EXPECT_EQ(status, 0) << out << err;
    expect_smallest(kept().refinement);
}

TEST_F(Shrinking, LeavesCasesThatHoldUnchanged) {
    const auto file = write("equality", "some");
    const auto [status, out, err] = shrink({file, "1", "200", OCTETRA_TEST_PROGRAM});
    EXPECT_EQ(status, 1) << out << err;
    EXPECT_EQ(kept_file(), file);
    EXPECT_EQ(kept().refinement.mesh, some_case().mesh);
}

/// The limit is one second of processor time.
TEST_F(Shrinking, DoesNotTakeASlowCaseForABlockedOne) {
    const auto file = write("geometry", "some");
    const auto [status, out, err] = shrink({file, "0", "200", OCTETRA_FAULTY_LAWS});
    EXPECT_EQ(status, 1) << out << err;
    EXPECT_EQ(kept_file(), file);
}

TEST_F(Shrinking, TakesNoProgramThatDoesNotStartForADeath) {
    const auto file = write("equality", "some");
    const auto [status, out, err] = shrink({file, "0", "200", "./no-such-program"});
    EXPECT_EQ(status, 2) << out << err;
    EXPECT_EQ(kept_file(), file);
}

TEST_F(Shrinking, EndsInTimeAndKeepsTheSmallestSoFar) {
    const auto begin = std::chrono::steady_clock::now();
    const auto [status, out, err] =
        shrink({write("numbering", "numbering-running-17"), "0", "8", OCTETRA_FAULTY_LAWS});
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
    EXPECT_EQ(status, 0) << out << err;
    EXPECT_NE(out.find("time is up"), out.npos) << out;
    EXPECT_LE(kept().refinement.mesh.cells.size(), some_case().mesh.cells.size());
    EXPECT_TRUE(is_faulty(kept().refinement));
    EXPECT_FALSE(is_running_name(kept_file().stem()));
}

/// Like Ctrl-C, the signal of `timeout` reaches all processes in the foreground.
TEST_F(Shrinking, KeepsTheSmallestSoFarWhenInterrupted) {
    const auto file = write("numbering", "numbering-running-17");
    const auto [status, out, err] = test::run_program(
        {"timeout", "--preserve-status", "-s", "INT", "20", "env", "OCTETRA_CPU_SECONDS=2",
         OCTETRA_SHRINK_FINDING, file, "0", "200", OCTETRA_FAULTY_LAWS},
        file.parent_path());
    EXPECT_EQ(status, 130) << out << err;
    EXPECT_NE(out.find("\nreplay: "), out.npos) << out;
    EXPECT_LT(kept().refinement.mesh.cells.size(), some_case().mesh.cells.size());
    EXPECT_TRUE(is_faulty(kept().refinement));
    EXPECT_FALSE(is_running_name(kept_file().stem()));
}

}  // namespace
}  // namespace octetra::properties
