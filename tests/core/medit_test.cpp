#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "core/refused_files.hpp"
#include "support/thrown.hpp"

namespace octetra {
namespace {

using test::RefusedFiles;
using testing::HasSubstr;

const std::string head = "MeshVersionFormatted 2\nDimension 3\n";
const std::string vertices = "Vertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
const std::string cells = "Tetrahedra\n1\n1 2 3 4 5\n";
const std::string whole_cell = head + vertices + cells;
const std::string good = head + vertices + cells + "End\n";

Mesh read_medit_text(const std::string& text, const ReadOptions& options = {}) {
    return test::read_content("m.mesh", text, options);
}

TEST(MeditFile, HasReferencesThatAreWholeNumbersHoweverTheyAreWritten) {
    const Mesh mesh = read_medit_text(
        head + vertices + "Tetrahedra\n1\n1 2 3 4 -0\nTriangles\n4\n1 2 3 +7\n1 2 4 -12\n" +
        "1 3 4 -2147483648\n2 3 4 1e2\nEdges\n5\n1 2 999999999\n1 3 -999999999\n" +
        "1 4 1000000000\n2 3 2147483647\n2 4 0005.0\nEnd\n");
    EXPECT_TRUE(mesh.regions.empty());
    EXPECT_THAT(mesh.facet_markers, testing::ElementsAre(7, -12, -2147483648, 100));
    EXPECT_THAT(mesh.edge_markers,
                testing::ElementsAre(999999999, -999999999, 1000000000, 2147483647, 5));
    for (const char* reference : {"-", "--1", "-+1", "1-", "2147483648", "-2147483649", "1.5"}) {
        const std::string text = head + vertices + "Tetrahedra\n1\n1 2 3 4 " + reference + "\n";
        const std::string message =
            test::thrown_by<InputError>([&] { (void)read_medit_text(text); });
        EXPECT_THAT(message, HasSubstr("/m.mesh:11: the reference should be a "));
        EXPECT_THAT(message, HasSubstr(fmt::format("not '{}'", reference)));
    }
}

void read_refused_text(const std::string& text) { (void)read_medit_text(text); }

const std::vector<test::Refusal<std::string>> bad_texts{
    {"Empty", "", 1, "the file is empty"},
    {"Garbage", std::string("\x00\x01\x02\xff\xfe", 5), 1, "begins with MeshVersionFormatted"},
    {"VersionZero", "MeshVersionFormatted\n0\nDimension 3\n", 2, "versions 1 to 4, not 0"},
    {"VersionFive", "MeshVersionFormatted 5\nDimension 3\n", 1, "versions 1 to 4, not 5"},
    {"OnlyHead", head, 2, "no section Vertices"},
    {"Dimension", "MeshVersionFormatted 2 Dimension 2", 1, "dimension 3 expected, 2 found"},
    {"OfMfem", "MFEM mesh v1.0\n\ndimension\n3\n", 1, "this is a mesh of MFEM; of .mesh files"},
    {"BehindParallelSections", whole_cell + "ParallelCommunicatorVertices\n1 1 0\nx\nEnd\n", 14,
     "a keyword expected, 'x' found"},
    {"UnknownKeyword", head + vertices + "Tetraheda\n0\nEnd\n", 9, "'Tetraheda' found"},
    {"ExtraNumber", head + "Vertices\n1\n0 0 0 0 0\nEnd\n", 5, "a keyword expected, '0' found"},
    {"MissingNumber", head + "Vertices\n2\n0 0 0 0\n0 0 0\nEnd\n", 7,
     "the vertex's reference should be a number, not 'End'"},
    {"EndsEarly", head + "Vertices\n2\n0 0 0 0\n0 0", 6, "the file ends where z should be"},
    {"CountHuge", head + "Vertices\n4000000000\n", 4, "holds at most"},
    {"NaN", head + "Vertices\n1\n0 nan 0 0\n", 5, "y is not finite"},
    {"BeyondMidpoints", head + "Vertices\n1\n0 0 -9e307 0\n", 5, "z is '-9e307': coordinates"},
    {"VertexZero", head + vertices + "Tetrahedra\n1\n0 1 2 3 0\nEnd\n", 11, "there is no vertex 0"},
    {"VertexTooLarge", head + vertices + "Tetrahedra\n2\n1 2 3 4 0\n1 2 3 5 0\nEnd\n", 12,
     "there is no vertex 5"},
    {"VertexTwice", head + vertices + "Tetrahedra\n1\n1 2 2 4 0\nEnd\n", 11,
     "the cell has the same vertex twice"},
    {"Inverted", head + vertices + "Tetrahedra\n1\n2 1 3 4 0\nEnd\n", 11, "inverted"},
    {"Flat", head + "Vertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n1 1 0 0\nTetrahedra 1\n1 2 3 4 0", 9,
     "flat"},
    {"SecondOrder", head + vertices + "TetrahedraP2\n0\nEnd\n", 9, "second-order"},
    {"Hexahedra", head + vertices + "Hexahedra\n1\n1 2 3 4 1 2 3 4 0\nEnd\n", 9,
     "only tetrahedral"},
    {"SkippedCountThatOverflows", head + vertices + "Normals 6148914691236517206\n1 2\nEnd\n", 9,
     "holds at most"},
    {"FlatAmongScatteredLines",
     head + "Vertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n1 1 0 0\nTetrahedra\n1\n1 2\n3 4 0", 8,
     "cell 1 of this section: the cell is flat"},
    {"FlatAmongLinesThatOnlyAddUp",
     head + "Vertices 5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n1 1 0 0\n0 0 1 0\nTetrahedra\n3\n1 2\n" +
         "3 5 0\n1 2 3 5 0 1 2 3 4 0\n",
     9, "cell 3 of this section: the cell is flat"},
    {"TwoSections", head + vertices + vertices + "End\n", 9, "the first is on line 3"},
    {"AfterEnd", good + "Corners\n0\n", 13, "text after the keyword End"},
    {"StrayTriangle", head + vertices + cells + "Triangles\n1\n1 2 2 0\nEnd\n", 14,
     "the triangle has the same vertex twice"},
    {"CornerZero", whole_cell + "Corners\n1\n0\nEnd\n", 14, "there is no vertex 0"},
    {"CornerNegative", whole_cell + "Corners\n1\n-1\nEnd\n", 14,
     "a number should be a whole number from 0, not '-1'"},
    {"CornerTooLarge", whole_cell + "Corners\n4\n4\n9\n1\n9\nEnd\n", 15,
     "there is no vertex 9: the file has 4"},
    {"CornerBeyondIndices", whole_cell + "Corners\n1\n4294967296\nEnd\n", 14,
     "there is no vertex 4294967296"},
    {"CornerBeforeVertices", head + "Corners\n1\n5\n" + vertices + "End\n", 5,
     "there is no vertex 5: the file has 4"},
    {"RidgeWithoutEdges", whole_cell + "Ridges\n1\n1\nEnd\n", 14,
     "there is no edge 1: the file has 0"},
    {"RequiredTriangleTooLarge",
     whole_cell + "RequiredTriangles\n2\n1\n2\nTriangles\n1\n1 2 3 0\nEnd\n", 15,
     "there is no triangle 2: the file has 1"},
    {"RequiredCellTooLarge", whole_cell + "RequiredTetrahedra\n1\n2\nEnd\n", 14,
     "there is no cell 2: the file has 1"},
    {"CornersCountHuge", whole_cell + "Corners\n4000000000\n1\n", 13, "holds at most"},
    {"CornersTwice", whole_cell + "Corners\n1\n1\nCorners\n1\n2\nEnd\n", 15,
     "a second section Corners; the first is on line 12"},
    {"CornersMissing", whole_cell + "Corners\n2\n1\nEnd\n", 15,
     "a number should be a whole number from 0, not 'End'"},
    {"TriangleOfNoCell",
     head + "Vertices\n5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n9 9 9 0\n" + cells +
         "Triangles\n2\n1 2 3 0\n1 2 5 0\nEnd\n",
     16, "triangle 2 belongs to no cell"},
    {"FractionalReference", head + vertices + "Tetrahedra\n1\n1 2 3 4 .5\nEnd\n", 11,
     "the reference should be a whole number"},
};

INSTANTIATE_TEST_SUITE_P(Medit, RefusedFiles,
                         test::refusals("m.mesh", read_refused_text, bad_texts),
                         test::name_of_case);

TEST(MeditReader, KeepsTagsAndDropsReferencesThatAreAllZero) {
    const Mesh mesh = read_medit_text(good);
    EXPECT_EQ(mesh.regions.front(), 5);
    EXPECT_TRUE(mesh.point_markers.empty());
    EXPECT_EQ(mesh.index_base, 1U);
}

TEST(MeditReader, TakesTokensAcrossLinesInAnyOrderWithComments) {
    EXPECT_EQ(read_medit_text(
                  "# a mesh\r\nMeshVersionFormatted\r\n2 Dimension 3 Tetrahedra 1 1\r\n2 3 # ...\n"
                  "4 5\nVertices 4 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0 Hexahedra 0 End"),
              read_medit_text(good));
}

/// Versions differ in the width of binary numbers; as text they are the same.
TEST(MeditReader, TakesVersionsOneToFour) {
    for (const std::string version : {"1", "2", "3", "4"}) {
        std::string text = good;
        text.replace(text.find('2'), 1, version);
        EXPECT_EQ(read_medit_text(text), read_medit_text(good)) << version;
    }
}

TEST(MeditReader, TakesCarriageReturnsAloneForBlanks) {
    std::string text = good;
    std::ranges::replace(text, '\n', '\r');
    EXPECT_EQ(read_medit_text(text), read_medit_text(good));
}

TEST(MeditReader, SkipsUnsupportedSectionsWithANote) {
    std::string note;
    const Mesh mesh = read_medit_text(
        head + vertices + "NormalAtVertices\n2\n1 1\n2 1\nNormals 1 0 0 1\n" + cells + "End",
        {.note = [&](const auto& n) { note += n + "\n"; }});
    EXPECT_EQ(mesh, read_medit_text(good));
    EXPECT_THAT(note, HasSubstr("m.mesh:9: the 2 entries of NormalAtVertices are not kept"));
    EXPECT_THAT(note, HasSubstr("the 1 entries of Normals are not kept"));
}

/// As written by ParMmg for a part of a mesh.
TEST(MeditReader, SkipsTheSectionsOfParallelCommunicatorsWithANote) {
    for (const std::string kind : {"Triangle", "Vertex"}) {
        const std::string items = kind == "Vertex" ? "Vertices" : "Triangles";
        const std::string sections = "NumberOfPartitions\n3\n\nParallel" + kind +
                                     "Communicators\n2\n1 2\n2 1\n\nParallelCommunicator" + items +
                                     "\n1 1 0\n2 -1 0\n1 3 1\n";
        for (const std::string& text : {head + sections + vertices + cells + "End\n",
                                        whole_cell + sections + "\nEnd\n", whole_cell + sections}) {
            std::vector<std::string> notes;
            EXPECT_EQ(read_medit_text(text, {.note = [&](const auto& n) { notes.push_back(n); }}),
                      read_medit_text(good));
            const bool has_end = text.ends_with("End\n");
            ASSERT_EQ(notes.size(), has_end ? 3U : 4U);
            EXPECT_THAT(notes[0], HasSubstr("the section NumberOfPartitions is not kept"));
            EXPECT_THAT(notes[1],
                        HasSubstr("the 2 entries of Parallel" + kind + "Communicators are not"));
            EXPECT_THAT(notes[2],
                        HasSubstr("the section ParallelCommunicator" + items + " is not kept"));
        }
    }
}

TEST(MeditReader, ReadsAFileWithoutEndWithANote) {
    std::string note;
    EXPECT_EQ(read_medit_text(head + vertices + cells, {.note = [&](const auto& n) { note = n; }}),
              read_medit_text(good));
    EXPECT_THAT(note, HasSubstr("without the keyword End"));
}

TEST(MeditReader, RefusesAFileThatEndsBeforeItsTetrahedra) {
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_medit_text(head + vertices); }),
                HasSubstr("before the section Tetrahedra, and without the keyword End"));
    EXPECT_TRUE(read_medit_text(head + vertices + "End\n").cells.empty());  // it may have none
}

TEST(MeditReader, HasNoNotesOnAFileWithOnlyAHead) {
    EXPECT_THROW((void)read_medit_text(head, {.note = [](const auto& n) { FAIL() << n; }}),
                 InputError);
}

TEST(MeditReader, CorrectsInvertedCellsIfRequested) {
    const Mesh mesh = read_medit_text(head + vertices + "Tetrahedra\n1\n2 1 3 4 0\nEnd\n",
                                      {.fix_orientation = true});
    EXPECT_EQ(mesh.cells.front(),
              (CellVertices{VertexIndex{1}, VertexIndex{0}, VertexIndex{3}, VertexIndex{2}}));
}

}  // namespace
}  // namespace octetra
