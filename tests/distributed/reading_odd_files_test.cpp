#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/refine.hpp>

#include "core/meshb_files.hpp"
#include "distributed/mesh_texts.hpp"
#include "distributed/outcomes.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/temporary_folder.hpp"

/// Hand-made files, valid and invalid: collective reading has the same outcome as serial reading.
namespace octetra {
namespace {

namespace fs = std::filesystem;
using test::are_read_together;
using test::Case;
using test::expect_one_outcome;
using test::Files;
using test::replaced;
using test::write_on_first;

const std::string points = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
const std::string five_points = "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n";
const std::string one_cell = "1 4 0\n1 1 2 3 4\n";
const std::string medit_points =
    "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n"
    "1 0 0 0\n0 1 0 0\n0 0 1 0\n";

Files tetgen(const std::string& node, const std::string& ele, const std::string& face = {},
             const std::string& edge = {}) {
    Files files{".ele", {{".node", node}, {".ele", ele}}};
    if (!face.empty()) files.texts.emplace_back(".face", face);
    if (!edge.empty()) files.texts.emplace_back(".edge", edge);
    return files;
}
Files medit(const std::string& text) { return {".mesh", {{".mesh", text}}}; }
Files meshb(const test::MeshbFile& file) { return {".meshb", {{".meshb", file.bytes()}}}; }

std::vector<Case> odd_binary_files() {
    const auto start = [](int version = 2, bool swapped = false) {
        return test::MeshbFile(version, swapped).dimension();
    };
    const test::MeshbFile corner = start().corner();
    const test::MeshbFile cell = test::MeshbFile(corner).cell();
    const auto with = [](test::MeshbFile file, const auto& more) {
        more(file);
        return meshb(file.end());
    };
    using F = test::MeshbFile&;
    return {
        {"one cell", meshb(cell)},
        {"of the other byte order", meshb(start(2, true).corner().cell().end())},
        {"of 32 bits", meshb(start(1).corner().cell().end())},
        {"of 64 bits", meshb(start(4).corner().cell().end())},
        {"nothing", meshb(start().section(4, 0).end())},
        {"no cell", meshb(corner)},
        {"vertices last", meshb(start().cell().corner().end())},
        {"corners and a section that is not kept",
         with(cell, [](F f) { f.section(13, 1).row({3}).keyword(50); })},
        {"a facet and an edge",
         with(cell,
              [](F f) {
                  f.section(6, 1).row({1, 3, 2, 9}).section(5, 1).row({4, 3, 8});
              })},
        {"an inverted cell",
         with(corner,
              [](F f) {
                  f.section(8, 1).row({2, 1, 3, 4, 5});
              }),
         false},
        {"a cell twice",
         with(corner,
              [](F f) {
                  f.section(8, 2).row({1, 2, 3, 4, 5}).row({2, 3, 1, 4, 5});
              }),
         false},
        {"a facet twice, markers differ",
         with(cell,
              [](F f) {
                  f.section(6, 2).row({1, 2, 3, 9}).row({3, 2, 1, 8});
              }),
         false},
        {"a vertex twice",
         with(corner,
              [](F f) {
                  f.section(8, 1).row({1, 2, 3, 3, 5});
              }),
         false, false},
        {"a vertex that there is not",
         with(corner,
              [](F f) {
                  f.section(8, 1).row({1, 2, 3, 5, 5});
              }),
         false, false},
        {"not a number", with(start(), [](F f) { f.section(4, 1).point(0, HUGE_VAL, 0, 0); }),
         false, false},
        {"hexahedra", with(cell, [](F f) { f.section(10, 1); }), false, false},
        {"a count too large",
         with(cell,
              [](F f) {
                  f.section(5, 9).row({1, 2, 3});
              }),
         false, false},
        {"a circle of keywords", meshb(test::MeshbFile(cell).section(5, 0).set_next(8)), false,
         false},
        {"no vertices", meshb(start().end()), false, false},
        {"text", {".meshb", {{".meshb", "MeshVersionFormatted 2\n"}}}, false, false},
        {"an empty file", {".meshb", {{".meshb", ""}}}, false, false},
    };
}

std::vector<Case> odd_files() {
    const std::string two_cells = "2 4 0\n1 1 2 3 4\n2 4 2 3 5\n";
    const std::string cells = "Tetrahedra\n1\n1 2 3 4 7\n";
    return {
        {"one cell", tetgen(points, one_cell)},
        {"no cell", tetgen(points, "0 4 0\n")},
        {"nothing", tetgen("0 3 0 0\n", "0 4 0\n")},
        {"markers announced of nothing", tetgen("0 3 2 1\n", "0 4 1\n", "0 1\n", "0 1\n")},
        {"empty lists", tetgen(points, one_cell, "0 1\n", "0\n")},
        {"adjacent cells",
         tetgen(points, one_cell, "2 1\n1 1 2 3 5 1 -1\n2 1 2 4 5 1 -1\n", "1 1\n1 1 2 7 1\n")},
        {"adjacent cells of some", tetgen(points, one_cell, "2 1\n1 1 2 3 5 1 -1\n2 1 2 4 5\n"),
         false, false},
        {"adjacent cells of all but the first",
         tetgen(points, one_cell, "2 1\n1 1 2 3 5\n2 1 2 4 5 1 -1\n"), false, false},
        {"short headers", tetgen("4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n", "1\n1 1 2 3 4\n")},
        {"a vertex of no cell", tetgen(five_points, one_cell)},
        {"two cells", tetgen(five_points, two_cells, "1 1\n1 2 3 4 9\n")},
        {"a facet of both, twice", tetgen(five_points, two_cells, "2 1\n1 2 3 4 9\n2 4 3 2 9\n")},
        {"a facet twice, markers differ",
         tetgen(five_points, two_cells, "2 1\n1 2 3 4 9\n2 4 3 2 8\n"), false},
        {"an edge twice, markers differ",
         tetgen(five_points, two_cells, {}, "2 1\n1 2 3 9\n2 3 2 8\n"), false},
        {"a facet of no cell", tetgen(five_points, two_cells, "1 1\n1 1 2 5 9\n"), false},
        {"a facet at a vertex of no cell", tetgen(five_points, one_cell, "1 1\n1 1 2 5 9\n"),
         false},
        {"an edge of no cell", tetgen(five_points, two_cells, {}, "1 1\n1 1 5 9\n"), false},
        {"a cell twice", tetgen(five_points, "3 4 0\n1 1 2 3 4\n2 4 2 3 5\n3 2 3 1 4\n"), false},
        {"cells on one side of a facet",
         tetgen("5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 0 0 2\n",
                "2 4 0\n1 1 2 3 4\n2 1 2 3 5\n", "1 1\n1 1 2 3 9\n"),
         false},
        {"an inverted cell", tetgen(points, "1 4 0\n1 2 1 3 4\n"), false},
        {"a flat cell", tetgen("4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n", one_cell), false},
        {"a count too large", tetgen("5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n", one_cell),
         false, false},
        {"a count too small", tetgen("3 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n", one_cell),
         false, false},
        {"counted from 2", tetgen("4 3\n2 0 0 0\n3 1 0 0\n4 0 1 0\n5 0 0 1\n", one_cell), false,
         false},
        {"a number left out", tetgen("4 3\n1 0 0 0\n2 1 0 0\n4 0 1 0\n5 0 0 1\n", one_cell), false,
         false},
        {"cells counted otherwise", tetgen(points, "1 4 0\n0 1 2 3 4\n"), false, false},
        {"an empty file", tetgen("", one_cell), false, false},
        {"a line of a mebibyte", tetgen(points + std::string(1U << 20U, ' '), one_cell), false,
         false},
        {"zeros are none", medit(medit_points + "Tetrahedra\n1\n1 2 3 4 0\nEnd\n")},
        {"regions", medit(medit_points + cells + "End\n")},
        {"counts beside keywords", medit("MeshVersionFormatted\n2\nDimension\n3\nVertices 4\n"
                                         "0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n  Tetrahedra 1\n"
                                         "1 2 3 4 7\nTriangles 0\nCorners 0\nEnd")},
        {"no end", medit(medit_points + cells)},
        {"vertices last", medit("MeshVersionFormatted 2\nDimension 3\n" + cells +
                                medit_points.substr(medit_points.find("Vertices")) + "End\n")},
        {"nothing but a head", medit("MeshVersionFormatted 2\nDimension 3\nVertices\n0\nEnd\n")},
        {"sections that are not kept",
         medit(medit_points + "Corners 2\n1\n2\n\n# x\nTangents\n1\n1 0 0.5\nRidges\n0\n" + cells +
               "\nNormals\n1\n0 0 1\nEnd\n")},
        {"two sections of one kind",
         medit(medit_points + "Corners\n1\n2\n" + cells + "Corners\n1\n3\nEnd\n"), false, false},
        {"a section that is too long", medit(medit_points + cells + "Corners\n1\n1\n2\nEnd\n"),
         false, false},
        {"a section that is too short", medit(medit_points + cells + "Corners\n3\n1\n2\nEnd\n"),
         false, false},
        {"two numbers of a section on a line",
         medit(medit_points + cells + "Corners\n2\n1 2\nEnd\n"), true, false},
        {"entities over lines", medit(medit_points + "Tetrahedra\n1\n1 2\n3 4 7\nEnd\n"), true,
         false},
        {"two entities on a line", medit(medit_points + cells + "Edges\n2\n1 2 1 3 4 1\nEnd\n"),
         true, false},
        {"an entity beside its count", medit(medit_points + "Tetrahedra\n1 1 2 3 4 7\nEnd\n"), true,
         false},
        {"sections on a line",
         medit(replaced(medit_points, "\nDimension 3", " Dimension 3") + cells + "End\n")},
        {"text behind the end", medit(medit_points + cells + "End\n1\n"), false, false},
        {"a keyword behind the end", medit(medit_points + cells + "End\nCorners 0\n"), false,
         false},
        {"numbers before the head", medit("1 2\n" + medit_points + cells + "End\n"), false, false},
        {"numbers between sections",
         medit(replaced(medit_points, "Vertices", "3\nVertices") + cells + "End\n"), false, false},
        {"two dimensions", medit(replaced(medit_points, "ion 3", "ion 2") + cells), false, false},
        {"version 5", medit(replaced(medit_points, "ted 2", "ted 5") + cells), false, false},
        {"not a number", medit(replaced(medit_points, "1 0 0 0", "1 nan 0 0") + cells), false,
         false},
        {"a line that is no number", medit(replaced(medit_points, "1 0 0 0", "nan 0 0 0") + cells),
         false, false},
        {"an extra field", medit(replaced(medit_points, "1 0 0 0", "1 0 0 0 5") + cells + "End\n"),
         false, false},
        {"a second section", medit(medit_points + cells + cells + "End\n"), false, false},
        {"no vertices", medit("MeshVersionFormatted 2\nDimension 3\n" + cells + "End\n"), false,
         false},
        {"a vertex that there is not", medit(medit_points + "Tetrahedra\n1\n1 2 3 5 7\nEnd\n"),
         false, false},
        {"vertex 0", medit(medit_points + "Tetrahedra\n1\n0 2 3 4 7\nEnd\n"), false, false},
        {"a vertex twice", medit(medit_points + "Tetrahedra\n1\n1 2 3 3 7\nEnd\n"), false, false},
        {"hexahedra", medit(medit_points + "Hexahedra\n1\n1 2 3 4 1 2 3 4 0\nEnd\n"), false, false},
        {"no hexahedra", medit(medit_points + cells + "Hexahedra\n0\nEnd\n")},
        {"many words", medit(medit_points + replaced(std::string(3000, 'x'), "x", "x\n")), false,
         false},
    };
}

TEST(ReadTogether, OddFilesHaveTheOutcomeOfSerialReading) {
    for (const auto& cases : {odd_files(), odd_binary_files()}) {
        for (const Case& one : cases) {
            SCOPED_TRACE(one.name);
            const bool is_alone = test::world().size() == 1;  // it reads every form
            EXPECT_EQ(are_read_together(one.files), one.together || (is_alone && one.is_mesh));
            EXPECT_EQ(expect_one_outcome(one.files), one.is_mesh);
        }
    }
}

TEST(ReadTogether, MissingFilesAreReportedWithTheMessageOfSerialReading) {
    const test::SharedFolder folder;
    write_on_first([&] {
        test::write_file(folder / "a.ele", one_cell);
        fs::create_directory(folder / "b.mesh");
        fs::create_directory(folder / "c.node");
        test::write_file(folder / "c.ele", one_cell);
        fs::create_symlink("nowhere", folder / "d.face");
        test::write_file(folder / "d.node", points);
        test::write_file(folder / "d.ele", one_cell);
    });
    for (const std::string name : {"a.ele", "a.node", "b.mesh", "c.ele", "d.ele", "e.ele", "e.mesh",
                                   "e.meshb", "e.vtu", "e"}) {
        EXPECT_FALSE(test::expect_one_outcome(folder / name, "rcb")) << name;
    }
    (void)test::world().max(0);
}

/// Inverted cells are corrected by serial reading, because their number must be reported.
TEST(ReadTogether, InvertedCellsAreCorrectedIfRequested) {
    const test::SharedFolder folder;
    tetgen(points, "1 4 0\n1 2 1 3 4\n").write(folder);
    const auto read = [&](const auto& how) {
        return test::outcome_of([&](ReadOptions options) {
            options.fix_orientation = true;
            return how(options);
        });
    };
    const test::Outcome expected =
        read([&](const ReadOptions& options) { return read_mesh(folder / "m.ele", options); });
    const test::Outcome found = read([&](const ReadOptions& options) {
        return collect(distributed::read_parts(test::world(), folder / "m.ele",
                                               distributed::parse_partition("rcb"),
                                               {options, {}, {}}))
            .mesh;
    });
    EXPECT_EQ(expected.notes.size(), 1U);
    EXPECT_TRUE(!test::world().is_first() || found == expected);
    (void)test::world().max(0);
}

}  // namespace
}  // namespace octetra
