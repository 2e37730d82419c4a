#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "cli/octetra_program.hpp"

/// Names of physical groups, through every command, on any number of ranks.
namespace octetra {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

const std::vector<GroupName> names_of_box{
    {0, 6, "corner"},         {1, 5, "ridge"},     {2, 3, "floor #1"}, {2, 4, "interface"},
    {2, 9, "floor and roof"}, {3, 2, "air above"}, {3, 7, "steel"}};

class GroupNames : public testing::Test {
protected:
    GroupNames() {
        for (const std::string name : {"gmsh-box-22.msh", "gmsh-box-41b.msh"}) {
            std::filesystem::copy_file(OCTETRA_SOURCE_DIR "/corpus/meshes/" + name, folder / name);
        }
    }
    [[nodiscard]] test::Outcome run(const std::string& arguments, int ranks = 0) const {
        const std::string command = arguments + " --quiet";
        auto outcome =
            ranks == 0 ? test::octetra(command, folder) : test::octetra_on(ranks, command, folder);
        EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
        return outcome;
    }
    [[nodiscard]] std::vector<GroupName> names_in(const std::string& file) const {
        return read_mesh(folder / file).group_names;
    }

    const TemporaryFolder folder;
};

TEST_F(GroupNames, AreThoseOfTheInputInEveryFormThatIsWritten) {
    for (const std::string input : {"gmsh-box-22.msh", "gmsh-box-41b.msh"}) {
        for (const std::string form : {"4.1", "4.1-text", "2.2", "2.2-text"}) {
            (void)run("convert " + input + " a.msh --msh-format " + form);
            EXPECT_EQ(names_in("a.msh"), names_of_box) << input << ' ' << form;
        }
    }
}

TEST_F(GroupNames, StayThroughRefiningOnAnyNumberOfRanks) {
    const std::string refine = "refine gmsh-box-41b.msh --sphere 0,0,0,0.6 --levels 2 ";
    (void)run(refine + "--engine reference -o r.msh");
    EXPECT_EQ(names_in("r.msh"), names_of_box);
    for (const int ranks : {1, 2, 3, 4}) {
        for (const std::string how : {"", "--partition rcb", "--verify"}) {
            (void)run(refine + how + " -o p.msh", ranks);
            EXPECT_EQ(test::content_of(folder / "r.msh"), test::content_of(folder / "p.msh"))
                << ranks << " ranks " << how;
        }
    }
}

TEST_F(GroupNames, SelectRegionsByTag) {
    const std::string mesh = "gmsh-box-41b.msh ";
    (void)folder.write("tag.txt", "refine --region 7 --levels 2\n");
    (void)folder.write("name.txt", "refine --region steel --levels 2\n");
    (void)run("refine " + mesh + "--region 7 --levels 2 -o tag.msh");
    (void)run("refine " + mesh + "--region 7 --levels 2 -o tag.octetra");
    (void)run("coarsen tag.octetra --region 7 -o tag-coarser.msh");
    for (const int ranks : {0, 3}) {
        for (const std::string& command :
             {"refine " + mesh + "--region steel --levels 2",
              "refine " + mesh + "--region steel --levels 2 --engine reference",
              "adapt " + mesh + "--script name.txt",
              "adapt " + mesh + "--script name.txt --engine reference"}) {
            (void)run(command + " -o name.msh", ranks);
            EXPECT_EQ(test::content_of(folder / "tag.msh"), test::content_of(folder / "name.msh"))
                << command << ' ' << ranks;
        }
        (void)run("coarsen tag.octetra --region steel -o name-coarser.msh", ranks);
        EXPECT_EQ(test::content_of(folder / "tag-coarser.msh"),
                  test::content_of(folder / "name-coarser.msh"));
    }
    EXPECT_EQ(test::octetra("verify " + mesh + "tag.msh --region steel --levels 2", folder).status,
              0);
    EXPECT_EQ(test::octetra("verify " + mesh + "tag.msh --region 2 --levels 2", folder).status, 1);
}

TEST_F(GroupNames, OfSeveralGroupsSelectAllOfThem) {
    std::string text = test::content_of(folder / "gmsh-box-22.msh");
    const std::size_t at = text.find("\"air above\"");
    ASSERT_NE(at, std::string::npos);
    (void)folder.write("same.msh", text.replace(at, 11, "\"steel\""));
    (void)run("refine same.msh --region steel -o name.msh");
    (void)run("refine same.msh --region 2 --region 7 -o tags.msh");
    EXPECT_EQ(test::content_of(folder / "name.msh"), test::content_of(folder / "tags.msh"));
    (void)run("refine same.msh --region 7 -o one.msh");
    EXPECT_NE(test::content_of(folder / "name.msh"), test::content_of(folder / "one.msh"));
}

TEST_F(GroupNames, ThatNoGroupHasAreRefusedWithThoseThereAre) {
    for (const int ranks : {0, 2}) {
        const std::string command = "refine gmsh-box-41b.msh --region steal -o x.msh";
        const auto outcome =
            ranks == 0 ? test::octetra(command, folder) : test::octetra_on(ranks, command, folder);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_THAT(outcome.err, HasSubstr("--region: no group of cells is called 'steal'; there "
                                           "are air above, steel\n"));
    }
    (void)run("generate two-material -o m.ele");
    const auto outcome = test::octetra("refine m.ele --region steel -o x.msh", folder);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr("no group of cells of this mesh has a name"));
}

TEST_F(GroupNames, AreShownWithTheMesh) {
    const auto table = test::octetra("info gmsh-box-41b.msh", folder);
    EXPECT_THAT(table.out, HasSubstr("\n  7 steel  "));
    EXPECT_THAT(table.out, HasSubstr("\n  -3 floor #1  "));
    (void)run("convert gmsh-box-41b.msh m.octetra");
    for (const std::string mesh : {"gmsh-box-41b.msh", "m.octetra"}) {
        const auto info = nlohmann::json::parse(test::octetra("info --json " + mesh, folder).out);
        EXPECT_EQ(info["regions"][1]["name"], "steel");
        EXPECT_EQ(info["facet_markers"][0]["name"], "floor #1");
    }
}

/// By a script that refines and coarsens, and by checkpoints between the steps.
TEST_F(GroupNames, StayThroughHistoriesOnAnyNumberOfRanks) {
    const std::vector<std::string> steps{"refine --sphere 0,0,0,0.6 --levels 2",
                                         "coarsen --outside --sphere 0,0,0,0.3",
                                         "refine --region 2"};
    (void)folder.write("s.txt", steps[0] + "\nsave mid.octetra\n" + steps[1] + "\n" + steps[2]);
    (void)run("adapt gmsh-box-22.msh --script s.txt -o r.msh");
    (void)run("adapt gmsh-box-22.msh --script s.txt -o r.octetra");
    EXPECT_EQ(names_in("r.msh"), names_of_box);
    EXPECT_EQ(read_checkpoint_facts(folder / "mid.octetra").group_names, names_of_box);
    const auto expect_same = [&](const std::string& a, const std::string& b, int ranks) {
        EXPECT_TRUE(test::content_of(folder / a) == test::content_of(folder / b))
            << a << ' ' << b << ' ' << ranks;
    };
    for (const int ranks : {1, 2, 3, 4}) {
        (void)run("refine gmsh-box-22.msh" + steps[0].substr(6) + " -o 0.octetra", ranks);
        (void)run("coarsen 0.octetra" + steps[1].substr(7) + " -o 1.octetra", ranks);
        (void)run("refine 1.octetra" + steps[2].substr(6) + " -o 2.octetra", ranks);
        (void)run("refine 1.octetra" + steps[2].substr(6) + " -o 2.msh", ranks);
        expect_same("0.octetra", "mid.octetra", ranks);
        expect_same("2.octetra", "r.octetra", ranks);
        expect_same("2.msh", "r.msh", ranks);
    }
    (void)run("convert r.octetra c.msh");
    expect_same("c.msh", "r.msh", 1);
}

TEST_F(GroupNames, AreReportedOnceAsLostIfAFormatCannotStoreThem) {
    const std::string lost = "the names of groups are lost; .msh and .octetra files hold them";
    for (const std::string output : {"o.ele", "o.mesh", "o.vtu", "o.pvtu"}) {
        const auto converted = run("convert gmsh-box-41b.msh " + output);
        EXPECT_EQ(test::occurrences(converted.err, lost), 1U) << converted.err;
        for (const int ranks : {0, 3}) {
            const auto refined = run("refine gmsh-box-41b.msh --all -o " + output, ranks);
            EXPECT_EQ(test::occurrences(refined.err, lost), 1U) << output << '\n' << refined.err;
        }
    }
    for (const std::string output : {"o.msh", "o.octetra"}) {
        const auto refined = run("refine gmsh-box-41b.msh --all -o " + output, 2);
        EXPECT_EQ(test::occurrences(refined.err, lost), 0U) << refined.err;
    }
    (void)run("convert o.msh bare.mesh");
    EXPECT_EQ(test::occurrences(run("convert bare.mesh bare.vtu").err, lost), 0U);
}

/// A mesh in which each facet of one group is listed first in another group.
TEST_F(GroupNames, OfGroupsThatAreNeverFirstOfAnEntityStay) {
    const auto converted = run("convert gmsh-box-41b.msh o.msh");
    EXPECT_THAT(converted.err, HasSubstr("in more physical groups than one: the first is kept"));
    EXPECT_THAT(names_in("o.msh"), testing::Contains(GroupName{2, 9, "floor and roof"}));
}

}  // namespace
}  // namespace octetra
