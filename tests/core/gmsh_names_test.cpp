#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "core/gmsh_files.hpp"
#include "core/refused_files.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

/// Names of groups in Gmsh files.
namespace octetra {
namespace {

using test::gmsh_cell_2;
using test::gmsh_head_2;
using test::gmsh_nodes_2;
using test::RefusedFiles;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

/// The only cell of the fragments.
Mesh unnamed_cell() {
    Mesh mesh = test::one_cell(test::cube_corner);
    mesh.regions = {7};
    mesh.index_base = 1;
    return mesh;
}

/// The position of the first section of a binary file.
const std::size_t binary_head = test::gmsh_binary_head("4.1").size();

TEST(GmshNames, AreReadFromTextAndBinaryFiles) {
    const std::string names =
        "$PhysicalNames\n6\n3 7 \"rock # 1\"\n  2\t-5 \"a \"b\" c\" \n1 1 \"\"\n0 7 \"\xc3\xa9\"\n"
        "2 8 \"\xe9\"\n2 9 \"a\tb\"\n$EndPhysicalNames\n";
    Mesh expected = unnamed_cell();
    expected.group_names = {{3, 7, "rock # 1"}, {2, -5, "a \"b\" c"}, {0, 7, "\xc3\xa9"}};
    for (const std::string& file : {gmsh_head_2 + names + gmsh_nodes_2 + gmsh_cell_2,
                                    test::gmsh_binary_4().insert(binary_head, names)}) {
        const test::GmshRead found = test::read_gmsh(file);
        EXPECT_EQ(found.mesh, expected);
        EXPECT_THAT(found.notes, ElementsAre(EndsWith("m.msh: 3 names of groups are empty or not "
                                                      "valid UTF-8, and are not kept")));
    }
}

/// Gmsh may have assigned the group to a reversed entity.
TEST(GmshNames, OfElementsWithoutAMarkerAreTheReservedOne) {
    const std::string names = "$PhysicalNames\n2\n3 7 \"octetra:untagged\"\n2 7 \"wall\"\n" +
                              std::string("$EndPhysicalNames\n");
    Mesh expected = unnamed_cell();
    expected.regions.clear();
    expected.group_names = {{2, 7, "wall"}};
    for (const std::string& file :
         {gmsh_head_2 + names + gmsh_nodes_2 + gmsh_cell_2,
          gmsh_head_2 + names + gmsh_nodes_2 + "$Elements\n1\n1 4 2 -7 1 1 2 3 4\n$EndElements\n",
          test::gmsh_binary_4().insert(binary_head, names)}) {
        EXPECT_EQ(test::read_gmsh(file).mesh, expected);
    }
}

TEST(GmshNames, AreReadIfTheyAreNoLongerThanALineMayBe) {
    for (const std::size_t length : {std::size_t{100'000}, std::size_t{2'000'000}}) {
        Mesh expected = unnamed_cell();
        expected.group_names = {{3, 7, std::string(length, 'n')}};
        const std::string names =
            "$PhysicalNames\n1\n3 7 \"" + expected.group_names[0].name + "\"\n$EndPhysicalNames\n";
        for (const std::string& file : {gmsh_head_2 + names + gmsh_nodes_2 + gmsh_cell_2,
                                        test::gmsh_binary_4().insert(binary_head, names)}) {
            if (length == 100'000) {
                EXPECT_TRUE(test::read_gmsh(file).mesh == expected);
            } else {
                const std::string refusal =
                    test::thrown_by<InputError>([&] { (void)test::read_gmsh(file); });
                EXPECT_THAT(refusal, HasSubstr("line"));
                EXPECT_LT(refusal.size(), 1000U);
            }
        }
    }
}

const std::vector<test::Refusal<std::string>> bad_names{
    {"NameTwice", gmsh_head_2 + "$PhysicalNames\n2\n3 7 \"a\"\n3 7 \"b\"\n", 7,
     "group 7 of dimension 3 has two names"},
    {"NameOfNoGroup", gmsh_head_2 + "$PhysicalNames\n1\n7 \"a\"\n", 6,
     "a line of its dimension, its tag and \"the name\""},
    {"NameOfADimension", gmsh_head_2 + "$PhysicalNames\n1\n4 7 \"a\"\n", 6,
     "a line of its dimension"},
    {"NameOfANegativeDimension", gmsh_head_2 + "$PhysicalNames\n1\n-3 7 \"a\"\n", 6,
     "a line of its dimension"},
    {"NameOfAHugeTag", gmsh_head_2 + "$PhysicalNames\n1\n3 2147483648 \"a\"\n", 6,
     "a line of its dimension"},
    {"NameWithoutQuotes", gmsh_head_2 + "$PhysicalNames\n1\n3 7 rock\n", 6,
     "a line of its dimension"},
    {"NameTwiceBesideOneLeftOut", gmsh_head_2 + "$PhysicalNames\n2\n3 7 \"\"\n3 7 \"b\"\n", 7,
     "group 7 of dimension 3 has two names"},
    {"FewerNamesThanAreThere",
     gmsh_head_2 + "$PhysicalNames\n1\n3 7 \"a\"\n3 8 \"b\"\n$EndPhysicalNames\n", 7,
     "'$EndPhysicalNames' expected"},
    {"NamesTwice", gmsh_head_2 + "$PhysicalNames\n0\n$EndPhysicalNames\n$PhysicalNames\n", 7,
     "a second section $PhysicalNames"},
    {"NameWithoutItsEndBinary",
     test::gmsh_binary_4().insert(binary_head, "$PhysicalNames\n1\n3 7 \"a\n$EndPhysicalNames\n"),
     ": at byte ", "a line of its dimension"},
    {"NameWithoutItsEnd", gmsh_head_2 + "$PhysicalNames\n1\n3 7 \"a\n", 6,
     "a line of its dimension"},
    {"HugeNames", gmsh_head_2 + "$PhysicalNames\n99999999\n", 5, "holds at most"},
    {"NamesEnd", gmsh_head_2 + "$PhysicalNames\n2\n3 7 \"a\"\n", 6,
     "the file ends where the name of a group should be"},
};

INSTANTIATE_TEST_SUITE_P(GmshNames, RefusedFiles,
                         test::refusals("m.msh", test::read_refused_gmsh, bad_names),
                         test::name_of_case);

}  // namespace
}  // namespace octetra
