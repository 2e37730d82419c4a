#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "core/gmsh_files.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

/// Reading of Gmsh files, and the notes about them.
namespace octetra {
namespace {

using test::gmsh_cell_2;
using test::gmsh_cell_4;
using test::gmsh_entities_4;
using test::gmsh_head_2;
using test::gmsh_head_4;
using test::gmsh_nodes_2;
using test::gmsh_nodes_4;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

Mesh read_content(const std::string& content) { return test::read_gmsh(content).mesh; }

/// The only cell of the fragments.
Mesh one_cell() {
    Mesh mesh = test::one_cell(test::cube_corner);
    mesh.regions = {7};
    mesh.index_base = 1;
    return mesh;
}

TEST(GmshReader, ReadsAllFourKinds) {
    EXPECT_EQ(read_content(gmsh_head_2 + gmsh_nodes_2 + gmsh_cell_2), one_cell());
    EXPECT_EQ(read_content(gmsh_head_4 + gmsh_entities_4 + gmsh_nodes_4 + gmsh_cell_4), one_cell());
    EXPECT_EQ(read_content(test::gmsh_binary_2()), one_cell());
    EXPECT_EQ(read_content(test::gmsh_binary_4()), one_cell());
}

TEST(GmshReader, ReadsBinaryFilesOfTheOtherByteOrder) {
    EXPECT_EQ(read_content(test::gmsh_binary_2(true)), one_cell());
    EXPECT_EQ(read_content(test::gmsh_binary_4(true)), one_cell());
}

TEST(GmshReader, TakesBlanksCommentsLineEndsAndABom) {
    const auto with_crlf = [](const std::string& text) {
        std::string result = "\xef\xbb\xbf# a mesh\r\n\r\n";
        for (const char c : text)
            result += c == '\n' ? std::string("  # ...\r\n") : std::string(1, c);
        return result;
    };
    EXPECT_EQ(read_content(with_crlf(gmsh_head_2 + gmsh_nodes_2 + gmsh_cell_2)), one_cell());
    EXPECT_EQ(read_content(with_crlf(gmsh_head_4 + gmsh_entities_4 + gmsh_nodes_4 + gmsh_cell_4)),
              one_cell());
}

TEST(GmshReader, AssignsMarkerZeroToElementsOfNoGroup) {
    EXPECT_THAT(read_content(gmsh_head_4 + gmsh_nodes_4 + gmsh_cell_4).regions, IsEmpty());
    EXPECT_THAT(
        read_content(gmsh_head_2 + gmsh_nodes_2 + "$Elements\n1\n1 4 2 0 5 1 2 3 4\n$EndElements\n")
            .regions,
        IsEmpty());
    EXPECT_THAT(
        read_content(gmsh_head_2 + gmsh_nodes_2 + "$Elements\n1\n1 4 0 1 2 3 4\n$EndElements\n")
            .regions,
        IsEmpty());
}

const std::string all_kinds_2 = gmsh_head_2 + gmsh_nodes_2 +
                                "$Elements\n4\n"
                                "10 1 2 5 1 1 2\n"
                                "11 4 2 7 1 1 2 3 4\n"
                                "12 2 2 3 1 1 2 3\n"
                                "13 2 4 -4 2 1 2 1 2 4\n"
                                "$EndElements\n";

TEST(GmshReader, MakesTrianglesFacetsAndLinesEdgesInAnyOrder) {
    const Mesh mesh = read_content(all_kinds_2);
    EXPECT_EQ(mesh.cells, one_cell().cells);
    const VertexIndex a{0}, b{1}, c{2}, d{3};
    EXPECT_THAT(mesh.facets, ElementsAre(FacetVertices{a, b, c}, FacetVertices{a, b, d}));
    EXPECT_THAT(mesh.facet_markers, ElementsAre(3, -4));
    EXPECT_THAT(mesh.edges, ElementsAre(EdgeVertices{a, b}));
    EXPECT_THAT(mesh.edge_markers, ElementsAre(5));
}

TEST(GmshReader, TakesTheFirstGroupOfAnEntityWithANote) {
    const test::GmshRead found = test::read_gmsh(
        gmsh_head_4 + "$Entities\n0 0 1 1\n9 0 0 0 1 1 1 2 -3 8 0\n1 0 0 0 1 1 1 1 7 1 9\n" +
        "$EndEntities\n" + gmsh_nodes_4 +
        "$Elements\n2 2 1 2\n2 9 2 1\n1 1 2 3\n3 1 4 1\n2 1 2 3 4\n$EndElements\n");
    EXPECT_THAT(found.mesh.facet_markers, ElementsAre(-3));
    EXPECT_THAT(found.mesh.regions, ElementsAre(7));
    EXPECT_THAT(found.notes,
                ElementsAre(EndsWith(
                    "m.msh: 1 entities are in more physical groups than one: the first is kept")));
}

/// Version 2 lists an element once for each group, with reversed orientation if the group has it
/// reversed.
TEST(GmshReader, KeepsAnElementOfSeveralGroupsOnceWithANote) {
    const std::string elements =
        "$Elements\n5\n1 4 2 7 1 1 2 3 4\n2 4 2 8 1 1 2 3 4\n3 2 2 3 6 1 2 3\n4 2 2 9 6 2 1 3\n"
        "5 2 2 4 6 3 2 1\n$EndElements\n";
    const test::GmshRead found = test::read_gmsh(gmsh_head_2 + gmsh_nodes_2 + elements);
    EXPECT_THAT(found.mesh.regions, ElementsAre(7));
    EXPECT_THAT(found.mesh.facet_markers, ElementsAre(3));
    EXPECT_THAT(found.notes,
                ElementsAre(EndsWith(
                    "m.msh: 3 elements are in more physical groups than one: the first is kept")));
}

/// Elements of version 2 whose groups change at random, some of them listed repeatedly: as a text
/// file and as a binary one.
struct ListedElements {
    std::string text;
    std::string binary;
};

ListedElements listed_elements(std::mt19937& random, bool swapped) {
    const Mesh mesh = test::kuhn(5, 5, 5);
    struct Row {
        std::array<std::int32_t, 2> groups;  // physical, entity
        CellVertices nodes;
    };
    std::vector<Row> rows;
    std::array<std::int32_t, 2> groups{1, 1};
    const unsigned seldom = 1U << random() % 10;
    for (const CellVertices& cell : mesh.cells) {
        if (random() % seldom == 0) groups[random() % 2] = static_cast<std::int32_t>(random() % 3);
        rows.push_back({groups, cell});
        if (random() % seldom == 0) {
            rows.push_back({{groups[0] + 1, groups[1]}, cell});
            std::swap(rows.back().nodes[0], rows.back().nodes[1]);
            std::swap(rows.back().nodes[2], rows.back().nodes[3]);
        }
    }
    std::string text = fmt::format("{}$Nodes\n{}\n", gmsh_head_2, mesh.points.size());
    test::BinaryBytes binary(swapped);
    binary.text(test::gmsh_binary_head("2.2", swapped));
    binary.text(fmt::format("$Nodes\n{}\n", mesh.points.size()));
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.points.size()); ++v) {
        const Point& p = mesh.points[VertexIndex{static_cast<std::size_t>(v)}];
        text += fmt::format("{} {} {} {}\n", v + 1, p.x, p.y, p.z);
        binary.ints({v + 1}).reals({p.x, p.y, p.z});
    }
    text += fmt::format("$EndNodes\n$Elements\n{}\n", rows.size());
    binary.text(fmt::format("\n$EndNodes\n$Elements\n{}\n", rows.size()));
    binary.ints({4, static_cast<std::int32_t>(rows.size()), 2});
    std::int32_t number = 0;
    for (const auto& [of_row, cell] : rows) {
        std::array<std::int32_t, 4> n{};
        for (std::size_t k = 0; k < 4; ++k) n[k] = static_cast<std::int32_t>(cell[k].value()) + 1;
        ++number;
        text += fmt::format("{} 4 2 {} {} {}\n", number, of_row[0], of_row[1], fmt::join(n, " "));
        binary.ints({number, of_row[0], of_row[1], n[0], n[1], n[2], n[3]});
    }
    return {text + "$EndElements\n", binary.text("\n$EndElements\n").bytes()};
}

TEST(GmshReader, ReadsTheSameOfVersion2AsTextAndBinaryHoweverGroupsChange) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        std::mt19937 random(seed);
        const ListedElements listed = listed_elements(random, seed % 4 == 0);
        const test::GmshRead text = test::read_gmsh(listed.text);
        const test::GmshRead binary = test::read_gmsh(listed.binary);
        EXPECT_EQ(text.mesh.cells, binary.mesh.cells) << "seed " << seed;
        EXPECT_EQ(text.mesh.regions, binary.mesh.regions) << "seed " << seed;
        ASSERT_EQ(text.notes.size(), binary.notes.size()) << "seed " << seed;
        for (std::size_t i = 0; i < text.notes.size(); ++i) {
            const std::string& note = text.notes[i];
            EXPECT_THAT(binary.notes[i], EndsWith(note.substr(note.find("m.msh")))) << seed;
        }
        EXPECT_EQ(text.mesh.cells.size(), 750);
    }
}

TEST(GmshReader, ReportsElementsOfEntitiesThatAreNotListed) {
    const std::string nodes_of_two =
        "$Nodes\n1 5 1 5\n3 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n";
    const std::string elements =
        "$Elements\n2 2 1 2\n3 1 4 1\n1 1 2 3 4\n3 2 4 1\n2 2 3 4 5\n$EndElements\n";
    const test::GmshRead found =
        test::read_gmsh(gmsh_head_4 + gmsh_entities_4 + nodes_of_two + elements);
    EXPECT_THAT(found.mesh.regions, ElementsAre(7, 0));
    EXPECT_THAT(found.notes,
                ElementsAre(EndsWith("m.msh: 1 elements are of entities that $Entities does not "
                                     "list, and have no group")));
    // Some programs write no entities.
    EXPECT_THAT(test::read_gmsh(gmsh_head_4 + nodes_of_two + elements).notes, IsEmpty());
}

TEST(GmshReader, FindsNodesBySparseTagsInAnyOrder) {
    const std::string cell = "$Elements\n1\n1 4 1 7 ";
    for (const std::string tags : {"7 9 8 6", "4 3 2 1", "1 2 3 1000000000000", "1 2 3 5",
                                   "18446744073709551614 2 1 70", "0 1 2 3"}) {
        std::vector<std::string> tag(4);
        std::istringstream(tags) >> tag[0] >> tag[1] >> tag[2] >> tag[3];
        const std::string nodes = "$Nodes\n4\n" + tag[0] + " 0 0 0\n" + tag[1] + " 1 0 0\n" +
                                  tag[2] + " 0 1 0\n" + tag[3] + " 0 0 1\n$EndNodes\n";
        EXPECT_EQ(read_content(gmsh_head_2 + nodes + cell + tags + "\n$EndElements\n"), one_cell())
            << tags;
        for (const std::string other : {"99", "10", "18446744073709551615", "4000000000000"}) {
            EXPECT_THAT(test::thrown_by<InputError>([&] {
                            (void)read_content(gmsh_head_2 + nodes + cell +
                                               tags.substr(0, tags.rfind(' ') + 1) + other +
                                               "\n$EndElements\n");
                        }),
                        HasSubstr("m.msh:13: there is no node " + other));
        }
    }
}

TEST(GmshReader, SkipsAndCountsElementsThatAreNotPartOfAMesh) {
    const test::GmshRead found = test::read_gmsh(
        gmsh_head_2 + "$Comments\nwhatever\n$EndComments\n$PhysicalNames\n1\n3 7 \"rock # 1\"\n" +
        "$EndPhysicalNames\n" + gmsh_nodes_2 +
        "$Elements\n4\n1 15 2 9 1 1\n2 15 2 9 1 2\n3 3 2 1 1 1 2 3 4\n4 4 1 7 1 2 3 4\n"
        "$EndElements\n$Periodic\n0\n$EndPeriodic\n$NodeData\n1\n\"$Nodes\"\n$EndNodeData\n"
        "$NodeData\n$EndNodeData\n");
    Mesh named = one_cell();
    named.group_names = {{3, 7, "rock # 1"}};
    EXPECT_EQ(found.mesh, named);
    EXPECT_THAT(found.notes,
                ElementsAre(EndsWith("m.msh:25: the section 'Periodic' is not kept"),
                            EndsWith("m.msh:28: the section 'NodeData' is not kept"),
                            EndsWith("m.msh: 2 elements that are points are not kept"),
                            EndsWith("m.msh: 1 elements that are quadrangles are not kept")));
}

/// Also if the end of the section exceeds the block that is searched.
TEST(GmshReader, SkipsSectionsOfBinaryFilesByTheirEnd) {
    for (const std::size_t size :
         {0U, 1U, 65518U, 65519U, 65520U, 65530U, 65535U, 65536U, 3000000U}) {
        const test::GmshRead found =
            test::read_gmsh(test::gmsh_binary_4() + "$NodeData\n" + std::string(size, '\0') +
                            "\n$EndNodeData\n$Periodic\n" + "$EndPeriodic\n");
        EXPECT_EQ(found.mesh, one_cell());
        EXPECT_THAT(found.notes, ElementsAre(HasSubstr("'NodeData'"), HasSubstr("'Periodic'")));
    }
}

TEST(GmshReader, SkipsSectionsOfBinaryFilesThatEndWithoutALineEnd) {
    for (const std::size_t size : {0U, 1U, 65519U, 65524U, 65530U, 65535U, 65536U}) {
        const test::GmshRead found = test::read_gmsh(test::gmsh_binary_4() + "$NodeData\n" +
                                                     std::string(size, '\1') + "$EndNodeData\n");
        EXPECT_EQ(found.mesh, one_cell());
        EXPECT_THAT(found.notes, ElementsAre(HasSubstr("'NodeData'")));
    }
    for (std::string file : {test::gmsh_binary_2(), test::gmsh_binary_4()}) {
        for (const std::string section : {"MeshFormat", "Entities", "Nodes", "Elements"}) {
            const std::size_t end = file.find("\n$End" + section);
            if (end != std::string::npos) file.erase(end, 1);
        }
        EXPECT_EQ(read_content(file), one_cell());
    }
}

TEST(GmshReader, SkipsCommentsBeforeTheFormat) {
    const std::string comments = "$Comments\n$MeshFormat of its maker\n\n$EndComments\n";
    for (const std::string& file :
         {gmsh_head_2 + gmsh_nodes_2 + gmsh_cell_2, test::gmsh_binary_2(), test::gmsh_binary_4()}) {
        const test::GmshRead found = test::read_gmsh(comments + comments + file);
        EXPECT_EQ(found.mesh, one_cell());
        EXPECT_THAT(found.notes, IsEmpty());
    }
}

TEST(GmshReader, SkipsAndCountsLinesThatHaveOneNodeTwice) {
    const std::string rows_2 =
        "10 1 2 5 1 1 2\n14 1 2 5 1 2 2\n15 1 2 6 1 2 2\n16 1 2 6 1 2 3\n11 4 2 7 1 1 2 3 4\n";
    const std::string rows_4 = "1 1 1 4\n10 1 2\n14 2 2\n15 2 2\n16 2 3\n3 1 4 1\n11 1 2 3 4\n";
    for (const std::string& file :
         {gmsh_head_2 + gmsh_nodes_2 + "$Elements\n5\n" + rows_2 + "$EndElements\n",
          gmsh_head_4 + gmsh_nodes_4 + "$Elements\n2 5 10 16\n" + rows_4 + "$EndElements\n"}) {
        const test::GmshRead found = test::read_gmsh(file);
        EXPECT_THAT(found.mesh.edges, ElementsAre(EdgeVertices{VertexIndex{0}, VertexIndex{1}},
                                                  EdgeVertices{VertexIndex{1}, VertexIndex{2}}));
        EXPECT_EQ(found.mesh.cells, one_cell().cells);
        EXPECT_THAT(
            found.notes,
            ElementsAre(EndsWith("m.msh: 2 lines have the same node twice and are not kept")));
    }
}

TEST(GmshReader, JoinsPartitionsWithoutTheInterfacesBetweenThem) {
    const test::GmshRead found = test::read_gmsh(
        gmsh_head_4 + gmsh_entities_4 +
        "$PartitionedEntities\n2\n1\n5 1\n0 0 1 2\n"
        "2 3 1 2 1 2 0 0 0 1 1 1 0 0\n"
        "2 3 1 1 1 0 0 0 1 1 1 1 7 1 2\n"
        "3 3 1 1 2 0 0 0 1 1 1 1 8 1 -2\n"
        "$EndPartitionedEntities\n"
        "$Nodes\n1 5 1 5\n3 2 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 -1\n$EndNodes\n"
        "$Elements\n3 3 1 3\n2 2 2 1\n1 1 2 3\n3 2 4 1\n2 1 2 3 4\n3 3 4 1\n3 1 3 2 5\n"
        "$EndElements\n$GhostElements\n1\n2 1 1 2\n$EndGhostElements\n");
    EXPECT_THAT(found.mesh.regions, ElementsAre(7, 8));
    EXPECT_THAT(found.mesh.facets, IsEmpty());
    EXPECT_THAT(found.notes,
                ElementsAre(HasSubstr("'GhostElements' is not kept"),
                            EndsWith("m.msh: 1 elements between partitions are not kept")));
}

TEST(GmshReader, ReadsOverTheParametersOfNodes) {
    EXPECT_EQ(
        read_content(gmsh_head_4 + gmsh_entities_4 +
                     "$Nodes\n3 4 1 4\n0 1 1 1\n1\n0 0 0\n2 1 1 2\n2\n3\n1 0 0 .5 .5\n0 1 0 .5 1\n"
                     "1 1 1 1\n4\n0 0 1 .5\n$EndNodes\n" +
                     gmsh_cell_4),
        one_cell());
}

TEST(GmshReader, KeepsVerticesThatNoElementHas) {
    const std::string nodes = "$Nodes\n5\n9 5 5 5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
    const Mesh mesh = read_content(gmsh_head_2 + nodes + gmsh_cell_2);
    EXPECT_EQ(mesh.points.size(), 5U);
    EXPECT_EQ(mesh.cells.front()[0], VertexIndex{1});
}

TEST(GmshReader, TurnsInvertedCellsRoundIfAsked) {
    const TemporaryFolder folder;
    const auto file = folder.write(
        "m.msh", gmsh_head_2 + gmsh_nodes_2 + "$Elements\n1\n1 4 1 7 2 1 3 4\n$EndElements\n");
    std::vector<std::string> notes;
    const Mesh mesh = read_mesh(
        file, {.fix_orientation = true, .note = [&](const auto& n) { notes.push_back(n); }});
    EXPECT_EQ(mesh.cells.size(), 1U);
    EXPECT_THAT(notes, ElementsAre(EndsWith("m.msh: 1 inverted cells were reversed")));
}

}  // namespace
}  // namespace octetra
