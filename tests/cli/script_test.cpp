#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/octetra_program.hpp"

/// Scripts of octetra adapt: the syntax of lines, and the rejection of wrong lines before any step
/// is made.
namespace octetra {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using testing::HasSubstr;

class Script : public testing::Test {
protected:
    Script() {
        EXPECT_EQ(test::octetra("generate kuhn 2 -o m.mesh --quiet", folder).status, 0);
        (void)folder.write("cells.txt", "1 2 3\n");
        (void)folder.write("words.txt", "1\nx\n");
    }

    [[nodiscard]] test::Outcome adapt(const std::string& script,
                                      const std::string& options = "-o out.mesh") const {
        (void)folder.write("s.txt", script);
        return test::octetra("adapt m.mesh --script s.txt " + options, folder);
    }

    /// The wrong line follows a step that writes a file, which must not be created.
    void expect_refused(const std::string& line, const std::string& message) const {
        const auto run = adapt("# first\nwrite first.mesh\n\n" + line + "\n");
        EXPECT_EQ(run.status, 2) << line;
        EXPECT_EQ(run.err, "octetra: s.txt:4: " + message + "\n") << line;
        EXPECT_EQ(run.out, "") << line;
        EXPECT_FALSE(fs::exists(folder / "first.mesh")) << line;
        EXPECT_FALSE(fs::exists(folder / "out.mesh")) << line;
    }

    const TemporaryFolder folder;
};

struct WrongLine {
    std::string line;
    std::string message;
};

const std::vector<WrongLine> wrong_lines{
    {"refien --all",
     "a step begins with one of refine, coarsen, rebalance, save, write, not 'refien'; did you "
     "mean "
     "refine?"},
    {"--all", "a step begins with one of refine, coarsen, rebalance, save, write, not '--all'"},
    {"rebalance --all", "rebalance takes no options, but --all was given"},
    {"refine",
     "specify which cells to refine: --all, --cells, --sphere, --box, --region, --random or "
     "--max-volume"},
    {"coarsen --outside",
     "specify which cells to coarsen: --all, --cells, --sphere, --box, --region, --random or "
     "--max-volume"},
    {"refine --levels 2 --sphere 0,0,0,1 --spere 1",
     "refine has no option --spere; did you mean --sphere?"},
    {"refine --all -o x.mesh",
     "refine has no option -o; -o is for the command octetra adapt, not for a step: a line save "
     "FILE.octetra or write FILE writes the mesh"},
    {"coarsen --all --partition=rcb",
     "coarsen has no option --partition; --partition is for the command octetra adapt, not for a "
     "step"},
    {"write a#b.vtu",
     "a: the extension of a mesh to write must be .ele or .node (TetGen), .mesh or .meshb (Medit), "
     ".msh (Gmsh), .vtu, .pvtu or .vtkhdf (VTK), .xdmf (XDMF and HDF5), or .octetra (with its "
     "history); # begins a comment, also within a word"},
    {"save a#b.octetra",
     "save writes .octetra files, not a; write takes the other formats; # begins a comment, also "
     "within a word"},
    {"save a  # b", "save writes .octetra files, not a; write takes the other formats"},
    {"refine --all --help", "refine has no option --help"},
    {"refine --all --outside", "refine has no option --outside"},
    {"coarsen --all --scheme 4t", "coarsen has no option --scheme; did you mean --sphere?"},
    {"refine all", "refine does not expect 'all'"},
    {"refine --all=1", "--all takes no value"},
    {"refine --all --levels", "--levels requires a value, L:0 to 50"},
    {"refine --all --levels 1.5", "--levels takes a whole number from 0 to 50, not '1.5'"},
    {"coarsen --all --levels 51", "--levels takes a whole number from 0 to 50, not '51'"},
    {"refine --sphere 0,0,0", "--sphere takes 4 finite numbers as X,Y,Z,R, not '0,0,0'"},
    {"refine --sphere 0,0,0,-1", "--sphere: the radius is negative: 0,0,0,-1"},
    {"coarsen --random 2", "--random takes a number from 0 to 1, not '2'"},
    {"refine --all --seed 1", "--seed requires --random, as in --random 0.1 --seed 7"},
    {"refine --all --scheme 3t", "--scheme takes one of 8t, 4t, 2t, not '3t'"},
    {"refine --region 1", "--region: the cells of this mesh have no region tags"},
    {"coarsen --region 1", "--region: the cells of this mesh have no region tags"},
    {"refine --cells none.txt", "none.txt: cannot be opened: No such file or directory"},
    {"coarsen --cells words.txt",
     "words.txt:2: a cell number should be a whole number from 0, not 'x'"},
    {"coarsen --cells cells.txt --levels 2",
     "--cells refers to the cells of one mesh, but --levels also coarsens later ones; give only "
     "one of the two"},
    {"write", "write takes one word, the name of a file without blanks: write STEP.vtu"},
    {"write \"a b.vtu\"",
     "write takes one word, the name of a file without blanks: write STEP.vtu"},
    {"write step",
     "step: the extension of a mesh to write must be .ele or .node (TetGen), .mesh or .meshb "
     "(Medit), .msh (Gmsh), .vtu, .pvtu or .vtkhdf (VTK), .xdmf (XDMF and HDF5), or .octetra (with "
     "its history)"},
    {"write no/step.vtu", "no/step.vtu: there is no directory no; create it first"},
    {"save", "save takes one word, the name of a file without blanks: save STATE.octetra"},
    {"save x.vtu", "save writes .octetra files, not x.vtu; write takes the other formats"},
    {"save no/x.octetra", "no/x.octetra: there is no directory no; create it first"},
    {"write m.mesh", "write would write over m.mesh of MESH; choose another name"},
    {"write ./first.mesh",
     "line 2 and write name the same file, ./first.mesh, which is first.mesh"},
    {"write out.mesh", "-o and write name the same file, out.mesh"},
    {"refine --all\x01", "there is a control character in this line: not a text file?"},
    {std::string("write a\0b.vtu", 13),
     "there is a control character in this line: not a text file?"},
};

TEST_F(Script, WithAWrongLineIsRefusedByItsNumberBeforeAnythingIsDone) {
    for (const auto& [line, message] : wrong_lines) expect_refused(line, message);
}

TEST_F(Script, IsNotWrittenOverNorAreItsLists) {
    fs::create_symlink("s.txt", folder / "link.vtu");
    expect_refused("write link.vtu",
                   "write would write over link.vtu, which is s.txt, of --script; choose another "
                   "name");
    fs::create_symlink("cells.txt", folder / "cells.vtu");
    EXPECT_EQ(adapt("refine --cells cells.txt\n", "-o cells.vtu").err,
              "octetra: -o would write over cells.vtu, which is cells.txt, of --cells; choose "
              "another name\n");
    EXPECT_EQ(adapt("refine --all\n", "-o out.mesh --profile s.txt").err,
              "octetra: --profile would write over s.txt of --script; choose another name\n");
}

/// Through standard input and a pipe, which can be read only once.
TEST_F(Script, MayBeReadFromAPipe) {
    const std::string script =
        "\xef\xbb\xbf# near\r\nrefine --sphere 0,0,0,0.7 --levels 2 # twice\r\n\n"
        "\t coarsen --all\nsave s.octetra";
    ASSERT_EQ(adapt(script, "-o plain.mesh").status, 0);
    const auto piped = [&](const std::string& ending) {
        return test::run_program(
            {"sh", "-c", "cat s.txt | " OCTETRA_PROGRAM " adapt m.mesh " + ending}, folder.path());
    };
    for (const std::string from : {"-", "/dev/stdin"}) {
        const auto run = piped("-o piped.mesh --script " + from);
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(test::content_of(folder / "piped.mesh"), test::content_of(folder / "plain.mesh"));
        EXPECT_THAT(run.out, HasSubstr((from == "-" ? "stdin" : from) + ":2 refined, 2 levels"));
    }
    (void)folder.write("s.txt", "\n\nrefien\n");
    EXPECT_THAT(piped("-o no.mesh --script -").err, HasSubstr("octetra: stdin:3: a step begins"));
    (void)folder.write("s.txt", "# nothing");
    EXPECT_EQ(piped("-o no.mesh --script -").err,
              "octetra: stdin:1: there is no step in this file\n");
}

/// Messages count levels from the beginning of the script, also for a mesh with a history.
TEST_F(Script, NamesItsLevelsAlsoAfterAHistory) {
    const auto behind =
        adapt("refine --all\nrefine --all --levels 9\n", "--max-cells 5000 -o n.mesh");
    EXPECT_EQ(behind.err,
              "octetra: s.txt:2: level 3 would make 24576 cells, more than the 5000 allowed: mark "
              "fewer cells or levels, or allow more (levels count all steps that have made this "
              "mesh; this is level 2 of 9 here)\n");
    const auto first = adapt("refine --all --levels 9\n", "--max-cells 5000 -o n.mesh");
    EXPECT_EQ(first.err,
              "octetra: s.txt:1: level 3 would make 24576 cells, more than the 5000 allowed: mark "
              "fewer cells or levels, or allow more\n");
}

TEST_F(Script, ReportsWhetherNothingWasMarkedOrNothingCouldBeCoarsened) {
    EXPECT_EQ(adapt("refine --all\ncoarsen --sphere 9,9,9,1\n").err,
              "octetra: note: s.txt:2: no cell was marked: the mesh is unchanged\n");
    EXPECT_EQ(adapt("refine --all\ncoarsen --all --levels 2\n").err,
              "octetra: note: s.txt:2: no vertex could be removed any more after level 1 of 2\n");
}

TEST_F(Script, WithoutAStepIsRefused) {
    EXPECT_EQ(adapt("").err, "octetra: s.txt:1: the file is empty\n");
    EXPECT_EQ(adapt("\n# nothing\n").err, "octetra: s.txt:1: there is no step in this file\n");
    EXPECT_EQ(test::octetra("adapt m.mesh --script none.txt -o out.mesh", folder).err,
              "octetra: none.txt: cannot be opened: No such file or directory\n");
    EXPECT_EQ(test::octetra("adapt m.mesh --script . -o out.mesh", folder).err,
              "octetra: .: is not a file\n");
    EXPECT_FALSE(fs::exists(folder / "out.mesh"));
}

TEST_F(Script, MayHaveCommentsBlankLinesAnyLineEndsAndNoneAtTheEnd) {
    const std::string plain =
        "refine --sphere 0,0,0,0.7 --levels 2\ncoarsen --outside --sphere "
        "0,0,0,0.4\n";
    ASSERT_EQ(adapt(plain, "-o plain.mesh").status, 0);
    const std::vector<std::string> others{
        "# two steps\n\n" + plain + "\n  \t\n# done",
        "refine --sphere 0,0,0,0.7 --levels 2\r\ncoarsen --outside --sphere 0,0,0,0.4\r\n",
        "\xef\xbb\xbf\trefine  --sphere=0,0,0,0.7\t--levels 2 # near\n coarsen --outside --sphere "
        "0,0,0,0.4"};
    for (const std::string& script : others) {
        const auto run = adapt(script, "-o other.mesh");
        EXPECT_EQ(run.status, 0) << script << run.err;
        EXPECT_EQ(test::content_of(folder / "other.mesh"), test::content_of(folder / "plain.mesh"))
            << script;
    }
}

TEST_F(Script, NamesTheLineThatFailsAndKeepsFilesWrittenBefore) {
    const auto too_many =
        adapt("refine --all\nwrite one.mesh\nrefine --all\n", "-o out.mesh --max-cells 400");
    EXPECT_EQ(too_many.status, 2);
    EXPECT_EQ(too_many.err,
              "octetra: s.txt:3: level 2 would make 3072 cells, more than the 400 allowed: mark "
              "fewer cells or levels, or allow more (levels count all steps that have made this "
              "mesh; this is level 1 of 1 here)\n");
    EXPECT_TRUE(fs::exists(folder / "one.mesh"));
    EXPECT_FALSE(fs::exists(folder / "out.mesh"));
    (void)folder.write("cells.txt", "48\n49\n");
    EXPECT_EQ(adapt("# as it is\nrefine --cells cells.txt\n").err,
              "octetra: s.txt:2: cells.txt:2: there is no cell 49: the 48 cells are numbered from "
              "1\n");
    EXPECT_EQ(adapt("refine --all\nrefine --cells cells.txt\n").status, 0);
}

TEST_F(Script, ReportsTheEffectOfItsSteps) {
    const auto run = adapt(
        "refine --all\nrefine --sphere 9,9,9,1\ncoarsen --all --levels 3\nrefine --all --levels 0\n"
        "write step.mesh\n");
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.err,
              "octetra: note: s.txt:2: no cell was marked: the mesh is unchanged\n"
              "octetra: note: s.txt:3: no vertex could be removed any more after level 1 of 3\n"
              "octetra: note: s.txt:4: --levels 0: the mesh is unchanged\n");
    for (const std::string line :
         {"read m.mesh                               27 vertices            48 cells ",
          "s.txt:1 refined, 1 level                 125 vertices           384 cells ",
          "s.txt:2 refined, 0 levels                125 vertices           384 cells ",
          "s.txt:3 coarsened, 1 level                27 vertices            48 cells ",
          "s.txt:5 wrote step.mesh                   27 vertices            48 cells ",
          "wrote out.mesh                            27 vertices            48 cells "}) {
        EXPECT_THAT(run.out, HasSubstr(line));
    }
    EXPECT_THAT(run.out, HasSubstr(" s  (before: 125, 384)\n"));
    EXPECT_EQ(adapt("refine --all\n", "-o out.mesh --quiet").out, "");
}

}  // namespace
}  // namespace octetra
