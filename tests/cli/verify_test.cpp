#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/octetra_program.hpp"
#include "support/manifest.hpp"

/// octetra verify, octetra compare and refine --verify on the command line.
namespace octetra {
namespace {

using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Verify : public testing::Test {
protected:
    Verify() {
        expect_status(0, "generate gear -o gear.1.ele --quiet");
        expect_status(0, refine + " -o fine.1.ele --maps fine.maps --quiet");
    }
    test::Outcome expect_status(int status, const std::string& arguments) const {
        test::Outcome run = test::octetra(arguments, folder);
        EXPECT_EQ(run.status, status) << arguments << "\n" << run.out << run.err;
        return run;
    }
    nlohmann::json report() const { return nlohmann::json::parse(test::content_of(folder / "r")); }

    const TemporaryFolder folder;
    const std::string selection = " --sphere 1,0,0.15,0.4 --levels 2";
    const std::string refine = "refine gear.1.ele" + selection;
};

TEST_F(Verify, AcceptsTheResultsOfTheEngines) {
    EXPECT_THAT(expect_status(0, "verify gear.1.ele").out, HasSubstr("gear.1.ele: valid"));
    const auto run = expect_status(0, "verify gear.1.ele fine.1.ele --maps fine.maps" + selection);
    EXPECT_THAT(run.out, HasSubstr("fine.1.ele as a refinement of gear.1.ele: valid"));
    EXPECT_EQ(run.err, "");
    EXPECT_THAT(expect_status(0, "verify gear.1.ele fine.1.ele --fast").out,
                HasSubstr("gear.1.ele: valid, as far as --fast checks\n"));
    expect_status(0, "verify gear.1.ele fine.1.ele --min-dihedral 10");
}

TEST_F(Verify, ReportsThatTheRefinementRuleIsNotCheckedWithoutARequest) {
    const std::string words =
        "the refinement rule was not checked: give the request of refine, as in --all --levels 2";
    EXPECT_THAT(expect_status(0, "verify gear.1.ele fine.1.ele --fast --report r").out,
                HasSubstr("8T-LE                  skipped  " + words + "\n"));
    const auto last = report()["checks"].back();
    EXPECT_EQ(last["name"], "8T-LE");
    EXPECT_EQ(last["status"], "skipped");
    EXPECT_EQ(last["note"], words);
    for (const std::string other :
         {"verify gear.1.ele --fast", "verify gear.1.ele gear.1.ele --fast --all --levels 0"}) {
        EXPECT_THAT(expect_status(0, other).out, Not(HasSubstr("refinement rule")));
    }
}

TEST_F(Verify, EndsWithStatus1WhereTheAnswerIsNo) {
    const auto run = expect_status(1, "verify gear.1.ele fine.1.ele --all");
    EXPECT_THAT(run.out, AllOf(HasSubstr("missing_bisection"), HasSubstr("NOT VALID")));
    EXPECT_EQ(run.err, "");
    expect_status(1, "verify gear.1.ele fine.1.ele --min-dihedral 20");
    expect_status(1, "verify gear.1.ele --min-dihedral 10.5");
    expect_status(1, "verify fine.1.ele gear.1.ele");
}

TEST_F(Verify, JudgesFilesThatOthersRefuse) {
    const std::string bad = (test::corpus_folder() / "bad").string() + "/";
    const std::vector<std::pair<std::string, std::string>> cases{
        {"medit-inverted-cell.mesh", "repeated_cell: 1"},
        {"flat-cell.ele", "flat_cell: 1"},
        {"nearly-flat-cell.ele", "NOT VALID"},
        {"repeated-vertex.ele", "repeated_vertex: 1"},
        {"face-of-no-cell.ele", "stray_facet: 1"},
        {"medit-edge-of-no-cell.mesh", "stray_edge: 1"},
    };
    for (const auto& [file, what] : cases) {
        EXPECT_THAT(expect_status(1, "verify " + bad + file).out, HasSubstr(what));
    }
    for (const std::string file : {"index-out-of-range.ele", "nan.ele", "empty.mesh"}) {
        EXPECT_THAT(expect_status(2, "verify " + bad + file).err, HasSubstr(file.substr(0, 3)));
    }
}

TEST_F(Verify, ReportsAsJson) {
    expect_status(0, "verify gear.1.ele fine.1.ele --report r" + selection);
    const auto good = report();
    EXPECT_EQ(good["schema"], "octetra-verdict-1");
    EXPECT_EQ(good["valid"], true);
    EXPECT_EQ(good["mesh"], "fine.1.ele");
    EXPECT_EQ(good["coarse_mesh"], "gear.1.ele");
    EXPECT_TRUE(good["violations"].empty());
    EXPECT_TRUE(good["violation_counts"].empty());
    EXPECT_EQ(good["facts"]["cells"], 18246);
    EXPECT_GT(good["arithmetic"]["filtered"], 0);
    EXPECT_GT(good["arithmetic"]["exact"], 0);
    EXPECT_FALSE(good["angles_by_depth"].empty());
    ASSERT_EQ(good["volumes"].size(), 1U);
    EXPECT_EQ(good["volumes"][0]["region"], 0);
    EXPECT_NEAR(good["volumes"][0]["volume"], 0.658635, 1e-6);
    EXPECT_NEAR(good["volumes"][0]["coarse_volume"], 0.658635, 1e-6);
    EXPECT_LT(std::abs(good["volumes"][0]["difference"].get<double>()), 1e-15);
    double area = 0;
    for (const auto& sum : good["areas"]) area += sum["area"].get<double>();
    EXPECT_NEAR(area, 7.57625, 1e-5);

    expect_status(1, "verify gear.1.ele fine.1.ele --min-dihedral 12 --report r");
    const auto bad = report();
    EXPECT_EQ(bad["valid"], false);
    const std::size_t count = bad["violation_counts"]["dihedral_too_small"];
    EXPECT_EQ(bad["violations"].size(), count);
    EXPECT_EQ(bad["violations"][0]["code"], "dihedral_too_small");
    EXPECT_EQ(bad["violations"][0]["entities"][0]["kind"], "cell");
    const auto is_failed = [](const auto& check) { return check["status"] == "failed"; };
    EXPECT_EQ(std::ranges::count_if(bad["checks"], is_failed), 1);
    EXPECT_EQ(std::ranges::find_if(bad["checks"], is_failed)->at("name"), "dihedral angles");
}

TEST_F(Verify, ReadsTheMapsThatRefineWrites) {
    const std::string maps = test::content_of(folder / "fine.maps");
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = maps;
        text.replace(text.find(from), from.size(), to);
        (void)folder.write("changed.maps", text);
    };
    changed("\n0 0\n", "\n0 7\n");
    EXPECT_THAT(expect_status(1, "verify gear.1.ele fine.1.ele --maps changed.maps").out,
                HasSubstr("wrong_parent: 1"));
    changed("\n0 0\n", "\n2 0\n");
    EXPECT_THAT(expect_status(2, "verify gear.1.ele fine.1.ele --maps changed.maps").err,
                HasSubstr("changed.maps:2: cell number 0 expected"));
    changed("midpoints", "halves");
    EXPECT_THAT(expect_status(2, "verify gear.1.ele fine.1.ele --maps changed.maps").err,
                HasSubstr("'midpoints' expected"));
    changed("cells ", "cells 9");
    expect_status(2, "verify gear.1.ele fine.1.ele --maps changed.maps");
}

TEST_F(Verify, ReadsMapsByTheNumbersOfTheCoarseMeshWhateverTheFormatOfTheFine) {
    expect_status(0, refine + " -o fine.mesh --maps medit.maps --quiet");
    EXPECT_EQ(test::content_of(folder / "medit.maps"), test::content_of(folder / "fine.maps"));
    expect_status(0, "verify gear.1.ele fine.mesh --maps medit.maps");
}

TEST_F(Verify, FailsIfAFileLacksDataThatItsFormatCanStore) {
    const std::string coarse =
        (test::corpus_folder() / "meshes/attributes-and-markers.ele").string();
    expect_status(0, "refine " + coarse + " --all -o tagged.1.ele --quiet");
    expect_status(0, "refine " + coarse + " --all -o tagged.mesh --quiet");
    expect_status(0, "verify " + coarse + " tagged.1.ele");
    EXPECT_THAT(
        expect_status(0, "verify " + coarse + " tagged.mesh").out,
        HasSubstr("attributes             skipped  the format of the fine mesh cannot hold them"));
    expect_status(0, "refine " + coarse + " --all -o tagged.msh --quiet");
    EXPECT_THAT(
        expect_status(0, "verify " + coarse + " tagged.msh").out,
        HasSubstr("vertex markers         skipped  the format of the fine mesh cannot hold them"));
    std::filesystem::remove(folder / "tagged.1.face");
    std::filesystem::remove(folder / "tagged.1.edge");
    EXPECT_THAT(expect_status(1, "verify " + coarse + " tagged.1.ele").out,
                AllOf(HasSubstr("missing_facet"), HasSubstr("missing_edge")));
}

TEST_F(Verify, RefusesOptionsThatMeanNothing) {
    for (const std::string options :
         {"--min-dihedral nan", "--min-dihedral 181", "--levels 3", "--scheme 2t", "--levels 1",
          "--scheme 8t", "--seed 0", "--report -"}) {
        expect_status(2, "verify gear.1.ele fine.1.ele " + options);
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "-"));
}

TEST_F(Verify, ReportsWhatAnOptionExpects) {
    const auto message = [&](const std::string& options) {
        return expect_status(2, "verify gear.1.ele fine.1.ele " + options).err;
    };
    EXPECT_THAT(message("--min-dihedral abc"),
                HasSubstr("--min-dihedral takes a number from 0 to 180, not 'abc'\n"));
    EXPECT_THAT(message("--all --levels 1.5"),
                HasSubstr("--levels takes a whole number from 0 to 50, not '1.5'\n"));
    EXPECT_THAT(message("--random .1 --seed -1"),
                HasSubstr("--seed takes a whole number from 0 up, not '-1'\n"));
    EXPECT_THAT(message("--all --seed 3"), HasSubstr("--random 0.1 --seed 7"));
    EXPECT_THAT(message("--scheme 8t"), HasSubstr("as in --all --levels 2"));
}

TEST_F(Verify, ReportsWhoseNumbersTheyAreIfIndexBasesDiffer) {
    const std::string whose =
        "Numbers refer to fine.mesh, which counts from 1; those of coarse entities refer to "
        "gear.1.ele, which counts from 0.";
    expect_status(0, "convert fine.1.ele fine.mesh");
    EXPECT_THAT(expect_status(1, "verify gear.1.ele fine.mesh --all").out, HasSubstr(whose));
    EXPECT_THAT(expect_status(0, "verify gear.1.ele fine.mesh").out, Not(HasSubstr("Numbers")));
    EXPECT_THAT(expect_status(1, "verify gear.1.ele fine.1.ele --all").out,
                Not(HasSubstr("Numbers")));
}

TEST_F(Verify, OfRefineWritesWhatIsValidAndNothingElse) {
    const auto run = expect_status(0, refine + " -o again.1.ele --verify");
    EXPECT_THAT(run.out, HasSubstr("verified"));
    EXPECT_THAT(run.err, HasSubstr("note: of gear.1.ele itself, only orientation and"));
    EXPECT_EQ(test::content_of(folder / "again.1.ele"), test::content_of(folder / "fine.1.ele"));

    // Three cells at one face can be read and refined, but are not a valid mesh.
    (void)folder.write("three.node",
                       "6 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0 0 -1\n5 2 2 1\n");
    (void)folder.write("three.ele", "3 4 0\n0 0 1 2 3\n1 0 2 1 4\n2 0 1 2 5\n");
    expect_status(0, "refine three.ele --all -o out.ele --quiet");
    std::filesystem::remove(folder / "out.ele");
    const auto bad = expect_status(1, "refine three.ele --all -o out.ele --maps m.txt --verify");
    EXPECT_THAT(bad.out,
                AllOf(HasSubstr("face_of_many_cells: 1"), HasSubstr("nothing was written")));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.ele"));
    EXPECT_FALSE(std::filesystem::exists(folder / "m.txt"));
}

TEST_F(Verify, CompareReportsWhatIsTheSame) {
    expect_status(0, "convert gear.1.ele gear.mesh --quiet");
    EXPECT_THAT(expect_status(0, "compare gear.1.ele gear.mesh").out,
                HasSubstr("the same up to numbering"));
    EXPECT_THAT(expect_status(1, "compare gear.1.ele gear.mesh --identical").out,
                HasSubstr("one counts from 0, the other from 1"));
    EXPECT_THAT(expect_status(0, "compare gear.1.ele gear.1.node --identical").out,
                HasSubstr("identical"));
    test::write_file(folder / "zero.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    test::write_file(folder / "zero.ele", "1 4 0\n0 0 1 2 3\n");
    test::write_file(folder / "zero.face", "1 1\n0 0 2 1 0\n");
    expect_status(0, "convert zero.ele zero.mesh --quiet");
    EXPECT_THAT(expect_status(0, "compare zero.ele zero.mesh").out,
                HasSubstr("numbering: one counts from 0, the other from 1; one has markers or "
                          "region tags that are all 0, the other has none, and nothing else "));
    const auto run = expect_status(1, "compare gear.1.ele fine.1.ele");
    EXPECT_THAT(run.out, AllOf(HasSubstr("cell at ("), HasSubstr("absent in gear.1.ele"),
                               HasSubstr("different")));
    expect_status(2, "compare gear.1.ele missing.ele");
}

}  // namespace
}  // namespace octetra
