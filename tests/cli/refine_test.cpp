#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <octetra/core/files/mesh_files.hpp>

#include "cli/octetra_program.hpp"
#include "support/meshes.hpp"

namespace octetra {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

std::size_t cells_after(const TemporaryFolder& folder, const std::string& options) {
    const test::Outcome run = test::octetra("refine cube.ele -o fine.ele " + options, folder);
    EXPECT_EQ(run.status, 0) << options << "\n" << run.err;
    return read_mesh(folder / "fine.ele").cells.size();
}

class RefineCube : public testing::Test {
protected:
    RefineCube() {
        EXPECT_EQ(test::octetra("generate kuhn 8 -o cube.ele --quiet", folder).status, 0);
    }
    const TemporaryFolder folder;
};

TEST_F(RefineCube, BySphereHasThePublishedCounts) {
    EXPECT_EQ(cells_after(folder, "--sphere .5,.5,.5,.25"), 6624U);
    EXPECT_EQ(cells_after(folder, "--sphere .5,.5,.5,.25 --levels 2"), 25968U);
    EXPECT_EQ(cells_after(folder, "--sphere .5,.5,.5,.25 --levels 3 --engine reference"), 143016U);
}

TEST_F(RefineCube, ByEverySelectorMarksSomething) {
    (void)folder.write("cells.txt", "0 17 # two cells\n3071\n");
    for (const std::string option :
         {"--cells cells.txt", "--sphere 0,0,0,.2", "--sphere -1,0,0,1.1", "--box 0,0,0,.2,.2,.2",
          "--random .01 --seed 7", "--max-volume 3e-4", "--all",
          "--sphere 0,0,0,.1 --sphere 1,1,1,.1 --box .4,.4,.4,.5,.5,.5"}) {
        const std::size_t cells = cells_after(folder, option);
        EXPECT_GT(cells, 3072U) << option;
        EXPECT_LE(cells, 8 * 3072U) << option;
    }
}

TEST_F(RefineCube, SchemesSelectLessAndLess) {
    const std::string sphere = "--sphere .5,.5,.5,.25 --scheme ";
    const std::size_t eight = cells_after(folder, sphere + "8t");
    const std::size_t four = cells_after(folder, sphere + "4t");
    const std::size_t two = cells_after(folder, sphere + "2t");
    EXPECT_GT(eight, four);
    EXPECT_GT(four, two);
    EXPECT_GT(two, 3072U);
    for (const std::string made : {"8t", "4t", "2t"}) {
        (void)cells_after(folder, sphere + made);
        for (const std::string asked : {"8t", "4t", "2t"}) {
            EXPECT_EQ(test::octetra("verify cube.ele fine.ele " + sphere + asked, folder).status,
                      made == asked ? 0 : 1)
                << made << " judged as " << asked;
        }
    }
}

TEST_F(RefineCube, InTwoRunsIsTheSameBytesAsInOne) {
    ASSERT_EQ(test::octetra("refine cube.ele --random .1 --levels 2 -o once.ele", folder).status,
              0);
    ASSERT_EQ(test::octetra("refine cube.ele --random .1 -o first.ele", folder).status, 0);
    ASSERT_EQ(test::octetra("refine first.ele --random .1 -o twice.ele", folder).status, 0);
    for (const std::string extension : {"node", "ele", "face"}) {
        EXPECT_EQ(test::content_of(folder / ("once." + extension)),
                  test::content_of(folder / ("twice." + extension)));
    }
}

TEST_F(RefineCube, ByRegionNeedsTags) {
    const test::Outcome run = test::octetra("refine cube.ele --region 1 -o fine.ele", folder);
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("no region tags"));
}

TEST_F(RefineCube, RefusesCellsThatThereAreNot) {
    (void)folder.write("cells.txt", "5\n3072\n");
    const test::Outcome run = test::octetra("refine cube.ele --cells cells.txt -o f.ele", folder);
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("octetra: cells.txt:2: there is no cell 3072"));
}

TEST_F(RefineCube, NotesWhenNothingWasMarked) {
    const test::Outcome run = test::octetra("refine cube.ele --sphere 9,9,9,1 -o f.ele", folder);
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.err, HasSubstr("no cell was marked"));
}

TEST_F(RefineCube, QuietlyPrintsNothing) {
    const test::Outcome run = test::octetra("refine cube.ele --all -o f.ele --quiet", folder);
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.out + run.err, "");
}

TEST_F(RefineCube, WritesMapsOfParentsAndMidpoints) {
    (void)folder.write("cells.txt", "0");
    const auto run = test::octetra(
        "refine cube.ele --cells cells.txt --scheme 2t -o f.ele --maps maps.txt", folder);
    ASSERT_EQ(run.status, 0) << run.err;
    const Mesh fine = read_mesh(folder / "f.ele");
    std::istringstream maps(test::content_of(folder / "maps.txt"));
    std::string word;
    std::size_t cells = 0;
    maps >> word >> cells;
    EXPECT_EQ(word, "cells");
    ASSERT_EQ(cells, fine.cells.size());
    std::size_t previous_parent = 0;
    for (std::size_t c = 0; c < cells; ++c) {
        std::size_t cell = 0;
        std::size_t parent = 0;
        maps >> cell >> parent;
        EXPECT_EQ(cell, c);
        EXPECT_GE(parent, previous_parent);
        previous_parent = parent;
    }
    EXPECT_EQ(previous_parent, 3071U);
    std::size_t midpoints = 0;
    maps >> word >> midpoints;
    EXPECT_EQ(word, "midpoints");
    EXPECT_EQ(midpoints, fine.points.size() - 729);
    for (std::size_t m = 0; m < midpoints; ++m) {
        std::size_t vertex = 0;
        std::size_t a = 0;
        std::size_t b = 0;
        maps >> vertex >> a >> b;
        ASSERT_EQ(vertex, 729 + m);
        EXPECT_EQ(fine.points[VertexIndex{vertex}],
                  midpoint(fine.points[VertexIndex{a}], fine.points[VertexIndex{b}]));
    }
}

TEST(Refine, ReportsRoundingByFileCellAndLevelAndKeepsTheOldFile) {
    const TemporaryFolder folder;
    const double far = 0x1p52;
    (void)write_mesh(test::one_cell({{{far, 0, 0}, {far + 1, 0, 0}, {far, 1, 0}, {far, 0, 1}}}),
                     folder / "tiny.ele");
    (void)folder.write("fine.mesh", "as it was");
    const test::Outcome run = test::octetra("refine tiny.ele --all -o fine.mesh", folder);
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("octetra: tiny.ele: cell 0, level 1: "));
    EXPECT_EQ(test::content_of(folder / "fine.mesh"), "as it was");
}

TEST(Refine, CarriesRegionsFacetsAndEdgesOfASolid) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate two-material -o m.1.ele", folder).status, 0);
    const auto run = test::octetra("refine m.1.ele --region 2 --levels 2 -o fine.mesh", folder);
    ASSERT_EQ(run.status, 0) << run.err;
    ASSERT_EQ(test::octetra("info fine.mesh --json", folder).status, 0);
    const auto before = nlohmann::json::parse(test::octetra("info m.1.ele --json", folder).out);
    const auto after = nlohmann::json::parse(test::octetra("info fine.mesh --json", folder).out);
    ASSERT_EQ(before["regions"].size(), 2U);
    ASSERT_EQ(after["regions"].size(), 2U);
    for (std::size_t r = 0; r < 2; ++r) {
        EXPECT_NEAR(after["regions"][r]["volume"], before["regions"][r]["volume"], 1e-12);
        EXPECT_EQ(after["regions"][r]["tag"], before["regions"][r]["tag"]);
        EXPECT_NEAR(after["facet_markers"][r]["area"], before["facet_markers"][r]["area"], 1e-12);
    }
    EXPECT_EQ(after["regions"][1]["cells"], 64 * before["regions"][1]["cells"].get<int>());
}

/// A unit cube of six cells; each level halves lengths.
TEST(Refine, ReportsTheNumberOfCellsThatAreStillTooLarge) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate kuhn 1 -o cube.ele", folder).status, 0);
    const auto notes = [&](const std::string& options) {
        const std::string refine = "refine cube.ele -o fine.ele --max-volume 0.01 ";
        return test::octetra(refine + options, folder).err;
    };
    const std::string note =
        "octetra: note: 48 cells are larger than --max-volume after 1 level: more --levels may "
        "help\n";
    EXPECT_EQ(notes("--levels 1"), note);
    EXPECT_EQ(notes("--levels 1 --engine reference"), note);
    EXPECT_EQ(notes("--levels 2"), "");
}

TEST(Refine, OutOfMemoryIsAFailureOfTheSystemThatLeavesNothing) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate kuhn 8 -o cube.mesh", folder).status, 0);
    const auto with_little_memory = [&](const std::string& arguments) {
        return test::run_program(
            {"/bin/bash", "-c", "ulimit -v 200000; " OCTETRA_PROGRAM " " + arguments},
            folder.path());
    };
    if (with_little_memory("--version").status != 0) {
        GTEST_SKIP() << "built to need much address space, as with the address sanitizer";
    }
    const auto run = with_little_memory("refine cube.mesh --all --levels 50 -o f.mesh");
    EXPECT_EQ(run.status, 3);
    EXPECT_EQ(run.err, "octetra: out of memory\n");
    std::filesystem::remove(folder / "cube.mesh");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Refine, EndsBeforeALevelThatWouldMakeMoreCellsThanAllowed) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate kuhn 1 -o cube.ele", folder).status, 0);
    (void)folder.write("f.ele", "as it was");
    for (const std::string engine : {"distributed", "reference"}) {
        const auto refine = "refine cube.ele --all --levels 40 -o f.ele --engine " + engine;
        const auto run = test::octetra(refine + " --max-cells 1000", folder);
        EXPECT_EQ(run.status, 2);
        EXPECT_EQ(run.err,
                  "octetra: cube.ele: level 3 would make 3072 cells, more than the 1000 allowed: "
                  "mark fewer cells or levels, or allow more\n");
        EXPECT_EQ(test::content_of(folder / "f.ele"), "as it was");
        EXPECT_FALSE(std::filesystem::exists(folder / "f.node"));
    }
    EXPECT_EQ(
        test::octetra("refine cube.ele --all --levels 3 --max-cells 3072 -o g.ele", folder).status,
        0);
}

TEST(Refine, RefusesOptionsThatTheReferenceHasNoUseFor) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate kuhn 1 -o cube.ele", folder).status, 0);
    for (const std::string option : {"--sync neighbour", "--sync gateway", "--partition lepp",
                                     "--rebalance 0.1", "--partition file:parts.txt"}) {
        const std::string refine = "refine cube.ele --all -o f.ele --engine reference ";
        const auto run = test::octetra(refine + option, folder);
        EXPECT_EQ(run.status, 2) << option;
        EXPECT_EQ(run.err,
                  "octetra: --partition, --sync and --rebalance cannot be combined with --engine "
                  "reference, which uses one rank\n")
            << option;
        EXPECT_FALSE(std::filesystem::exists(folder / "f.ele"));
    }
}

TEST(Refine, TurnsInvertedCellsRoundOnlyWhenAsked) {
    const TemporaryFolder folder;
    (void)folder.write("m.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    (void)folder.write("m.ele", "1 4 0\n0 1 0 2 3\n");
    const test::Outcome refused = test::octetra("refine m.ele --all -o f.ele", folder);
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.err, HasSubstr("octetra: m.ele:2: the cell is inverted"));
    EXPECT_FALSE(std::filesystem::exists(folder / "f.ele"));
    const auto fixed = test::octetra("refine m.ele --all -o f.ele --fix-orientation", folder);
    EXPECT_EQ(fixed.status, 0);
    EXPECT_THAT(fixed.err, HasSubstr("1 inverted"));
}

/// Refines, and sends a signal as soon as the temporary file exists.
test::Outcome refine_interrupted_by(const std::string& signal, const TemporaryFolder& folder) {
    return test::run_program(
        {"sh", "-c",
         std::string(OCTETRA_PROGRAM) +
             " refine cube.ele --all --levels 2 --quiet -o fine.vtu & child=$!\n"
             "while ! ls fine.vtu.*.tmp >/dev/null 2>&1 && kill -0 $child 2>/dev/null; do :; done\n"
             "kill -s " +
             signal + " $child; wait $child"},
        folder.path());
}

TEST(Refine, EndedByASignalWhileItWritesLeavesNothingBehind) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate kuhn 16 -o cube.ele --quiet", folder).status, 0);
    for (const std::string signal : {"TERM", "HUP"}) {
        test::Outcome run;
        // On a loaded machine the program may be finished before the signal arrives; then it is run
        // again.
        for (int attempt = 0; attempt < 10 && run.status <= 0; ++attempt) {
            std::filesystem::remove(folder / "fine.vtu");
            run = refine_interrupted_by(signal, folder);
        }
        EXPECT_GT(run.status, 128) << "it should have been ended by the signal";
        for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
            EXPECT_THAT(entry.path().filename().string(), testing::StartsWith("cube."));
        }
    }
}

/// See tests/support/rename_interrupter.cpp.
TEST(Refine, EndedByASignalBetweenRenamesPutsAllFilesOfTheMeshInPlace) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate kuhn 2 -o cube.ele --quiet", folder).status, 0);
    const std::string refine = OCTETRA_PROGRAM " refine cube.ele --all --quiet -o ";
    ASSERT_EQ(test::run_program(test::words(refine + "whole.ele"), folder.path()).status, 0);
    const std::string preload = OCTETRA_RENAME_INTERRUPTER " OCTETRA_RENAMES=3 ";
    const std::string alone =
        "env ASAN_OPTIONS=verify_asan_link_order=0 OCTETRA_RENAMES=3 LD_PRELOAD=";
    const std::string on_two = "env OCTETRA_SECONDS_TO_END=1 " OCTETRA_SOURCE_DIR
                               "/tests/support/mpirun.sh 2 env LD_PRELOAD=";
    for (const std::string& run : {alone + OCTETRA_RENAME_INTERRUPTER " ", on_two + preload}) {
        for (const std::string extension : {".node", ".ele", ".face", ".edge"}) {
            (void)folder.write("fine" + extension, "of an older mesh\n");
        }
        const auto outcome =
            test::run_program(test::words(run + refine + "fine.ele"), folder.path());
        EXPECT_TRUE(test::reports_signal(outcome.status, SIGTERM))
            << outcome.status << ": " << run << outcome.err;
        for (const std::string extension : {".node", ".ele", ".face"}) {
            EXPECT_TRUE(test::content_of(folder / ("fine" + extension)) ==
                        test::content_of(folder / ("whole" + extension)))
                << run << extension;
        }
        EXPECT_FALSE(std::filesystem::exists(folder / "fine.edge")) << run;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
            EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
        }
    }
}

TEST(Refine, KilledBetweenRenamesLeavesNoMeshThatCanBeReadWithoutItsFacets) {
    for (const std::string rename : {"1", "2", "3"}) {
        const TemporaryFolder folder;
        ASSERT_EQ(test::octetra("generate kuhn 2 -o cube.ele --quiet", folder).status, 0);
        const std::string run =
            "env ASAN_OPTIONS=verify_asan_link_order=0 OCTETRA_KILLED_AT_RENAME=" + rename +
            " LD_PRELOAD=" OCTETRA_RENAME_INTERRUPTER " " OCTETRA_PROGRAM
            " refine cube.ele --all --quiet -o fine.ele";
        EXPECT_EQ(test::run_program(test::words(run), folder.path()).status, 128 + SIGKILL);
        EXPECT_EQ(test::octetra("info fine.ele", folder).status, 2) << rename;
    }
}

TEST(Refine, ContinuesIfItWasStartedToIgnoreASignal) {
    // As nohup does; a shell does the same with SIGINT for programs in the background.
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate kuhn 16 -o cube.ele --quiet", folder).status, 0);
    EXPECT_EQ(refine_interrupted_by("INT", folder).status, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "fine.vtu"));
}

}  // namespace
}  // namespace octetra
