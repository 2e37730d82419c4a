#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/lists.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "core/mesh_shares.hpp"
#include "core/refused_files.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

namespace octetra {
namespace {

using test::RefusedFiles;
using test::TemporaryFolder;
using testing::HasSubstr;

const std::string good_node = "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
const std::string good_ele = "1 4 0\n0 0 1 2 3\n";

struct Files {
    std::string node = good_node;
    std::string ele = good_ele;
    std::string face = {};
    std::string edge = {};
};

Mesh read_files(const Files& files, const ReadOptions& options = {}) {
    const TemporaryFolder folder;
    (void)folder.write("m.node", files.node);
    (void)folder.write("m.ele", files.ele);
    if (!files.face.empty()) (void)folder.write("m.face", files.face);
    if (!files.edge.empty()) (void)folder.write("m.edge", files.edge);
    test::expect_correct_shares(folder / "m.ele");
    return read_mesh(folder / "m.ele", options);
}

test::Place in(const std::string& file, int line) { return fmt::format("{}:{}: ", file, line); }

std::string with_line(std::string text, int line, const std::string& replacement) {
    std::size_t begin = 0;
    for (int i = 1; i < line; ++i) begin = text.find('\n', begin) + 1;
    return text.replace(begin, text.find('\n', begin) - begin, replacement);
}

Files node_line(int line, const std::string& text) {
    return {.node = with_line(good_node, line, text)};
}
Files node_file(const std::string& text) { return {.node = text}; }
Files ele_file(const std::string& text) { return {.ele = text}; }
Files face_file(const std::string& text) { return {.face = text}; }
Files edge_file(const std::string& text) { return {.edge = text}; }
/// Adds a vertex of no cell.
Files with_stray_vertex(Files files) {
    files.node = with_line(good_node, 1, "5 3") + "4 5 5 5\n";
    return files;
}
Files ele_line(int line, const std::string& text) {
    return {.ele = with_line(good_ele, line, text)};
}

void read_refused_files(const Files& files) { (void)read_files(files); }

const std::vector<test::Refusal<Files>> bad_files{
    {"EmptyNode", node_file(""), in("m.node", 1), "the file is empty"},
    {"OnlyComments", node_file("# nothing\n\n"), in("m.node", 2), "ends before its header"},
    {"Garbage",
     node_file(std::string("\x7f"
                           "ELF\x02\x00\x01\xff",
                           8)),
     in("m.node", 1), "should be a whole number from 0, not '\\x7fELF"},
    {"GarbageWithoutLineEnds", node_file(std::string(3U << 20U, '\xfe')), in("m.node", 1),
     "longer than 1 MiB"},
    {"MissingCoordinate", node_line(3, "1 1 0"), in("m.node", 3), "z is missing"},
    {"ExtraField", node_line(3, "1 1 0 0 9 8"), in("m.node", 3),
     "4 fields expected, 6 found; the first extra one is '9'"},
    {"NotANumber", node_line(4, "2 0 one 0"), in("m.node", 4), "y should be a number, not 'one'"},
    {"HalfANumber", node_line(4, "2 0 1x 0"), in("m.node", 4), "not '1x'"},
    {"TwoSigns", node_line(4, "2 0 +-1 0"), in("m.node", 4), "y should be a number, not '+-1'"},
    {"NaN", node_line(4, "2 0 nan 0"), in("m.node", 4), "y is not finite: 'nan'"},
    {"Infinity", node_line(4, "2 -inf 0 0"), in("m.node", 4), "x is not finite: '-inf'"},
    {"BeyondDoubles", node_line(4, "2 0 1e999 0"), in("m.node", 4), "y is out of range: '1e999'"},
    {"BeyondMidpoints", node_line(4, "2 9e307 1 0"), in("m.node", 4),
     "x is '9e307': coordinates must be"},
    {"Numbering", node_line(4, "7 0 1 0"), in("m.node", 4), "entry number 2 expected, 7 found"},
    {"FirstNumber", node_file("1 3 0 0\n5 0 0 0\n"), in("m.node", 2), "begins with 0 or 1"},
    {"CountTooLarge", node_line(1, "5 3 0 0"), in("m.node", 5), "ends after 4 of 5 entries"},
    {"CountTooSmall", node_line(1, "3 3 0 0"), in("m.node", 5), "more lines than the 3"},
    {"CountHuge", node_line(1, "99999999999 3 0 0"), in("m.node", 1), "holds at most"},
    {"CountNegative", node_line(1, "-4 3 0 0"), in("m.node", 1), "should be a whole number from 0"},
    {"CountBeyond64Bits", node_line(1, "99999999999999999999999 3 0 0"), in("m.node", 1),
     "out of range"},
    {"AttributesHuge", node_line(1, "4 3 18446744073709551615 0"), in("m.node", 1),
     "attributes per vertex"},
    {"Dimension", node_line(1, "4 2 0 0"), in("m.node", 1), "dimension 3 expected, 2 found"},
    {"HeaderTooLong", node_line(1, "4 3 0 0 0"), in("m.node", 1), "4 fields expected, 5 found"},
    {"MarkersFlag", node_line(1, "4 3 0 2"), in("m.node", 1), "0 or 1, not 2"},
    {"EmptyEle", ele_file(""), in("m.ele", 1), "the file is empty"},
    {"SecondOrder", ele_line(1, "1 10 0"), in("m.ele", 1), "second-order"},
    {"FiveCorners", ele_line(1, "1 5 0"), in("m.ele", 1), "4 vertices per cell expected, 5 found"},
    {"TwoAttributes", ele_line(1, "1 4 2"), in("m.ele", 1), "only one, the region tag"},
    {"FractionalRegion", ele_file("1 4 1\n0 0 1 2 3 1.5\n"), in("m.ele", 2),
     "the region tag should be a whole number"},
    {"HugeRegion", ele_file("1 4 1\n0 0 1 2 3 3e9\n"), in("m.ele", 2), "whole number of 32 bits"},
    {"HugeNegativeRegion", ele_file("1 4 1\n0 0 1 2 3 -2147483649\n"), in("m.ele", 2),
     "whole number of 32 bits"},
    {"CornerMissing", ele_line(2, "0 0 1 2"), in("m.ele", 2), "a vertex number is missing"},
    {"CornerOutOfRange", ele_line(2, "0 0 1 2 4"), in("m.ele", 2), "there is no vertex 4"},
    {"CornerNegative", ele_line(2, "0 0 1 2 -1"), in("m.ele", 2), "should be a whole number"},
    {"CornerBeyond32Bits", ele_line(2, "0 0 1 2 4294967299"), in("m.ele", 2),
     "there is no vertex 4294967299"},
    {"CornerTwice", ele_line(2, "0 0 1 1 3"), in("m.ele", 2), "same vertex twice"},
    {"Inverted", ele_line(2, "0 1 0 2 3"), in("m.ele", 2), "inverted"},
    {"Flat", node_file(with_line(good_node, 5, "3 1 1 0")), in("m.ele", 2), "flat"},
    {"CellCountHuge", ele_line(1, "99999999999 4 0"), in("m.ele", 1), "cells announced"},
    {"FaceCountHuge", face_file("99999999999 0\n0 0 1 2\n"), in("m.face", 1), "holds at most"},
    {"EdgeCountHuge", edge_file("99999999999 0\n0 0 1\n"), in("m.edge", 1), "holds at most"},
    {"OtherFirstNumber", ele_line(2, "1 0 1 2 3"), in("m.ele", 2), "entry number 0 expected"},
    {"StrayFace",
     with_stray_vertex(face_file("2 1\n0 0 1 2 7\n# the next one is stray\n1 0 1 4 7\n")),
     in("m.face", 4), "face 1 belongs to no cell"},
    {"StrayFaceOnItsLine", with_stray_vertex(face_file("2 1\n0 0 1 2 7\n1 0 1 4 7\n")),
     in("m.face", 3), "face 1 belongs to no cell"},
    {"FaceTwice", face_file("1 0\n0 0 1 0\n"), in("m.face", 2), "same vertex twice"},
    {"FaceExtraField", face_file("1 0\n0 0 1 2 -1\n"), in("m.face", 2),
     "4 fields expected, 5 found"},
    {"StrayEdge", with_stray_vertex(edge_file("1 0\n0 0 4\n")), in("m.edge", 2),
     "edge 0 belongs to no cell"},
    {"EdgeMarkerMissing", edge_file("1 1\n0 0 1\n"), in("m.edge", 2), "the marker is missing"},
    {"CutOffBeforeANumber", ele_file("1 4 0\n0 0 1 2"), in("m.ele", 2),
     "is missing; the file ends with this line, without a line end: was it cut off?"},
    {"CutOffInANumber", ele_file("1 4 0\n0 0 2 1 3"), in("m.ele", 2),
     "--fix-orientation; the file ends with this line, without a line end: was it cut "
     "off?"},
};

INSTANTIATE_TEST_SUITE_P(Tetgen, RefusedFiles, test::refusals("", read_refused_files, bad_files),
                         test::name_of_case);

TEST(TetgenReader, AsksWhetherAFileWasCutOffOnlyWhereItsLastLineHasNoEnd) {
    const std::string message =
        test::thrown_by<InputError>([] { (void)read_files({.ele = "1 4 0\n0 0 2 1 3\n"}); });
    EXPECT_THAT(message, testing::HasSubstr("--fix-orientation"));
    EXPECT_THAT(message, testing::Not(testing::HasSubstr("cut off")));
}

TEST(TetgenReader, TakesCommentsBlankLinesTabsAndCarriageReturns) {
    const Mesh plain = read_files({});
    const Files oddly_set{
        .node =
            "# head\r\n\r\n 4\t3 0 0 # counts\r\n0 0 0 0\r\n\n1 +1 0 0\r\n  2 0 1e0 0  \r\n"
            "3 0 0 1.000 # last\r\n# tail",
        .ele = "1 4 0\r\n\r\n0\t0\t1\t2\t3"};
    EXPECT_EQ(read_files(oddly_set), plain);
}

TEST(TetgenReader, TakesHeadersThatLeaveTheDefaultsOut) {
    EXPECT_EQ(
        read_files({.node = with_line(good_node, 1, "4"), .ele = with_line(good_ele, 1, "1")}),
        read_files({}));
}

TEST(TetgenReader, KeepsTheNumberingFromOne) {
    const Mesh mesh = read_files(
        {.node = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n", .ele = "1 4 0\n1 1 2 3 4\n"});
    EXPECT_EQ(mesh.index_base, 1U);
    EXPECT_EQ(mesh.cells.front()[0], VertexIndex{0});
}

TEST(TetgenReader, CorrectsAndCountsInvertedCellsIfRequested) {
    std::string note;
    const Mesh mesh =
        read_files({.ele = "1 4 0\n0 1 0 2 3\n"},
                   {.fix_orientation = true, .note = [&](const auto& n) { note = n; }});
    EXPECT_EQ(mesh.cells.front(),
              (CellVertices{VertexIndex{1}, VertexIndex{0}, VertexIndex{3}, VertexIndex{2}}));
    EXPECT_THAT(note, HasSubstr("1 inverted"));
}

TEST(TetgenReader, SkipsTheAdjacentCellsThatTetgenAddsWithNnWithANote) {
    std::string notes;
    const ReadOptions options{.note = [&](const auto& n) { notes += n + "\n"; }};
    const Files with_adjacency{.face = "2 1\n0 0 1 2 7 0 -1\n1 0 1 3 8 -1 0\n",
                               .edge = "2 1\n0 0 1 5 0\n1 0 2 6 0\n"};
    const Files without{.face = "2 1\n0 0 1 2 7\n1 0 1 3 8\n", .edge = "2 1\n0 0 1 5\n1 0 2 6\n"};
    EXPECT_EQ(read_files(with_adjacency, options), read_files(without));
    EXPECT_THAT(notes, HasSubstr("the adjacent cells of each face are not kept"));
    EXPECT_THAT(notes, HasSubstr("the adjacent cells of each edge are not kept"));
    EXPECT_THAT(test::thrown_by<InputError>(
                    [&] { (void)read_files({.face = "2 1\n0 0 1 2 7 0 -1\n1 0 1 3 8\n"}); }),
                HasSubstr("m.face:3: an adjacent cell is missing"));
}

TEST(TetgenReader, NamesTheCompanionThatIsMissing) {
    const TemporaryFolder folder;
    (void)folder.write("m.ele", good_ele);
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_mesh(folder / "m.ele"); }),
                testing::AllOf(HasSubstr("m.ele: "), HasSubstr("m.node is missing")));
    (void)folder.write("n.node", good_node);
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_mesh(folder / "n.node"); }),
                HasSubstr("n.ele is missing"));
}

TEST(TetgenReader, RefusesWhatIsNotAFile) {
    const TemporaryFolder folder;
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_mesh(folder / "none.ele"); }),
                HasSubstr("none.ele: cannot be opened: No such file"));
    std::filesystem::create_directory(folder / "d.mesh");
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_mesh(folder / "d.mesh"); }),
                HasSubstr("is not a file"));
    ASSERT_EQ(::mkfifo((folder / "p.mesh").c_str(), 0600), 0);  // and do not wait for a writer
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_mesh(folder / "p.mesh"); }),
                HasSubstr("is not a file"));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_mesh(folder / "m.stl"); }),
                HasSubstr("the extension of a mesh to read must be"));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_mesh(folder / "m.MESH"); }),
                HasSubstr("(with its history), in lower case"));
}

TEST(TetgenReader, ReportsFilesThatCannotBeOpened) {
    const TemporaryFolder folder;
    std::filesystem::create_symlink("loop.ele", folder / "loop.ele");
    std::filesystem::create_symlink("loop.node", folder / "loop.node");
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_mesh(folder / "loop.ele"); }),
                HasSubstr("loop.node: cannot be opened: Too many levels of symbolic links"));
    (void)folder.write("m.node", good_node);
    (void)folder.write("m.ele", good_ele);
    for (const std::string extension : {"edge", "face"}) {
        std::filesystem::create_symlink("gone", folder / ("m." + extension));
        EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_mesh(folder / "m.ele"); }),
                    HasSubstr("m." + extension + ": cannot be opened: No such file"));
    }
}

/// `count` cells round one edge of two hubs; their faces at the lower end of this edge are tagged.
Files fan(int count) {
    Files files{.node = fmt::format("{} 3\n0 0 0 -1\n1 0 0 1\n", count + 2),
                .ele = fmt::format("{} 4\n", count),
                .face = fmt::format("{} 0\n", count)};
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        files.node += fmt::format("{} {} {} 0\n", i + 2, std::cos(angle), std::sin(angle));
        files.ele += fmt::format("{} 0 {} {} 1\n", i, i + 2, (i + 1) % count + 2);
        files.face += fmt::format("{} {} {} 0\n", i, (i + 1) % count + 2, i + 2);
    }
    return files;
}

TEST(TetgenReader, TakesFansInTimeThatDoesNotGrowWithTheSquareOfTheirSize) {
    constexpr int count = 100000;  // a quadratic algorithm would exceed the time limit
    EXPECT_EQ(read_files(fan(count)).facets.size(), std::size_t{count});
}

TEST(TetgenReader, FindsTheFirstOfStrayFacesAmongMany) {
    Files files = fan(50);
    const std::string last = files.face.substr(files.face.rfind("49 "));
    files.face.replace(files.face.size() - last.size(), last.size(), "49 0 20 9\n");
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_files(files); }),
                HasSubstr("m.face:51: face 49 belongs to no cell"));
}

/// Cells are checked in blocks, but lines are read one by one.
TEST(TetgenReader, NamesTheFirstLineWithAnyFault) {
    constexpr std::size_t count = 600;
    for (const std::size_t flat : {0U, 7U, 255U, 256U, 300U, 599U}) {
        for (const std::size_t malformed :
             {0U, 6U, 8U, 254U, 255U, 256U, 257U, 301U, 511U, 512U, 599U}) {
            if (flat == malformed) continue;
            Files files;
            files.node = fmt::format("{} 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 1 1 0\n", count + 4);
            for (std::size_t i = 0; i < count; ++i) {
                files.node += fmt::format("{} 0 0 {}\n", i + 4, i + 1);
            }
            files.ele = fmt::format("{} 4 0\n", count);
            for (std::size_t i = 0; i < count; ++i) {
                const std::string_view end = i == malformed ? "x" : "";
                files.ele += fmt::format("{} 0 1 2 {}{}\n", i, i == flat ? 3 : i + 4, end);
            }
            const std::string what = flat < malformed ? "the cell is flat" : "should be";
            EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_files(files); }),
                        HasSubstr(fmt::format("m.ele:{}: ", std::min(flat, malformed) + 2)))
                << flat << " " << malformed;
            EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_files(files); }),
                        HasSubstr(what));
        }
    }
}

TEST(TetgenReader, TakesEveryMarkerOf32Bits) {
    EXPECT_EQ(read_files({.face = "2 1\n0 0 1 2 -2147483648\n1 1 2 3 2147483647\n"}).facet_markers,
              (IndexVector<FacetIndex, Marker>{std::numeric_limits<Marker>::min(),
                                               std::numeric_limits<Marker>::max()}));
}

TEST(TetgenReader, TakesFacesThatAreListedTwiceWithOneMarker) {
    EXPECT_EQ(read_files({.face = "3 1\n0 0 1 2 7\n1 0 1 3 8\n2 2 1 0 7\n"}).facet_markers,
              (IndexVector<FacetIndex, Marker>{7, 8, 7}));
}

TEST(CellList, IsReadAscendingAndOnce) {
    const TemporaryFolder folder;
    const auto list = folder.write("cells", "7 3 # two\r\n\n3\t1");
    EXPECT_THAT(read_cell_list(list, 1, 8),
                testing::ElementsAre(GlobalCell{0}, GlobalCell{2}, GlobalCell{6}));
}

TEST(CellList, RefusesCellsThatThereAreNot) {
    const TemporaryFolder folder;
    for (const std::string wrong : {"1\n9", "1\n0", "1\n-1", "1\nx", "1\n1.5"}) {
        const auto list = folder.write("cells", wrong);
        EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_cell_list(list, 1, 8); }),
                    HasSubstr("cells:2: "));
    }
}

}  // namespace
}  // namespace octetra
