#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/reference/refine.hpp>

#include "core/meshb_files.hpp"
#include "distributed/marked_mesh.hpp"
#include "distributed/mesh_texts.hpp"
#include "distributed/outcomes.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/temporary_folder.hpp"

/// A mesh that all processes read together is what one would read, and where it is broken they
/// say what one would say.
namespace octetra {
namespace {

namespace fs = std::filesystem;
using test::are_read_together;
using test::Case;
using test::expect_one_outcome;
using test::Files;
using test::files_of;
using test::mutated;
using test::partitions;
using test::replaced;
using test::write_on_first;

/// The meshes in a folder, by what they are called in commands.
std::vector<fs::path> meshes_in(const fs::path& folder) {
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        fs::path file = entry.path();
        for (const char* const extension : {".mesh", ".meshb", ".msh"}) {
            if (file.extension() == extension) files.insert(file);
        }
        if (file.extension() != ".ele" && file.extension() != ".node") continue;
        const fs::path ele = fs::path(file).replace_extension(".ele");
        files.insert(fs::exists(ele) ? ele : file);
    }
    return {files.begin(), files.end()};
}

fs::path corpus(const std::string& folder) {
    return fs::path(OCTETRA_SOURCE_DIR) / "corpus" / folder;
}

TEST(ReadTogether, EveryMeshOfTheCorpusIsWhatOneProcessReads) {
    int alone = 0;
    for (const fs::path& file : meshes_in(corpus("meshes"))) {
        if (!test::is_read_together(file)) ++alone;
        for (const std::string& partition : partitions) {
            EXPECT_TRUE(test::expect_one_outcome(file, partition)) << file;
        }
    }
    EXPECT_EQ(alone, 1);  // all on one line
}

TEST(ReadTogether, EveryBadFileOfTheCorpusIsRefusedInTheWordsOfOneProcess) {
    const std::vector<fs::path> files = meshes_in(corpus("bad"));
    EXPECT_GE(files.size(), 60U);
    for (const fs::path& file : files) EXPECT_FALSE(test::expect_one_outcome(file, "rcb")) << file;
}

TEST(ReadTogether, MeshesWithEverythingAreWhatOneProcessReads) {
    for (const std::string extension : {".ele", ".mesh", ".meshb"}) {
        for (const std::uint32_t index_base : {0U, 1U}) {
            for (const std::size_t n : {1U, 2U, 6U}) {
                const Files files =
                    files_of(test::featured(test::full_mesh(n, index_base), n), extension);
                EXPECT_TRUE(are_read_together(files)) << extension << ' ' << n;
                EXPECT_TRUE(expect_one_outcome(files)) << extension << ' ' << n;
            }
        }
    }
}

/// In a lattice many centroids have the same coordinate, and numbers decide.
TEST(ReadTogether, PartsAreThoseThatOneProcessWouldMake) {
    for (const Mesh& mesh : {test::full_mesh(5, 1), test::kuhn(5, 4, 3)}) {
        const test::SharedFolder folder;
        const fs::path file = folder / "m.ele";
        write_on_first([&] { (void)write_mesh(mesh, file); });
        for (const std::string& name : partitions) {
            const auto partition = distributed::parse_partition(name);
            const auto ranks = distributed::partition_cells(mesh, test::world().size(), partition);
            std::vector<std::uint64_t> expected;
            for (std::size_t c = 0; c < ranks.size(); ++c) {
                if (ranks[c] == test::world().rank()) expected.push_back(c);
            }
            const auto part = distributed::read_parts(test::world(), file, partition);
            EXPECT_EQ(part.cell_ancestors.roots, expected) << name;
        }
        (void)test::world().max(0);
    }
}

/// Interfaces are no part of what is collected: closure must go from part to part.
TEST(ReadTogether, MeshesAreRefinedAsTheReferenceRefinesThem) {
    const Selection selection{.random = RandomShare{0.1, 3}};
    const test::SharedFolder folder;
    for (const std::size_t n : {2U, 5U}) {
        const fs::path file = folder / fmt::format("{}.ele", n);
        write_on_first([&] { (void)write_mesh(test::full_mesh(n, 1), file); });
        const auto expected = reference::refine(read_mesh(file), selection, Scheme::eight, 2).mesh;
        for (const std::string& partition : partitions) {
            auto parts = distributed::read_parts(test::world(), file,
                                                 distributed::parse_partition(partition));
            distributed::refine(parts, selection, {.levels = 2});
            const Mesh found = collect(std::move(parts)).mesh;
            EXPECT_TRUE(!test::world().is_first() || found == expected) << n << partition;
        }
    }
    (void)test::world().max(0);
}

/// So that every process has many messages of cells.
TEST(ReadTogether, AMeshOfManyCellsIsWhatOneProcessReads) {
    Mesh mesh = test::kuhn(34, 33, 32, 1.0 / 3);
    test::list_boundary(mesh);
    for (const std::string extension : {".ele", ".meshb"}) {
        const Files files = files_of(mesh, extension);
        EXPECT_TRUE(are_read_together(files));
        EXPECT_TRUE(expect_one_outcome(files));
    }
}

/// Forms of the same files that all processes read together.
TEST(ReadTogether, CommentsBlanksAndLineEndsAreReadOver) {
    for (const std::string extension : {".ele", ".mesh"}) {
        const Files plain = files_of(test::full_mesh(2, 1), extension);
        const auto with = [&](const auto& change) {
            Files files = plain;
            for (auto& [ending, text] : files.texts) text = change(text);
            EXPECT_TRUE(are_read_together(files)) << extension;
            EXPECT_TRUE(expect_one_outcome(files)) << extension;
        };
        with([](const auto& text) { return replaced(text, "\n", "\r\n"); });
        with([](const auto& text) { return replaced(text, "\n", "\n\n \t\n"); });
        with([](const auto& text) { return replaced(text, "\n", " # Triangles\n  # End\n"); });
        with([](const auto& text) { return "# a comment\n\n" + text; });
        with([](const auto& text) { return "\xef\xbb\xbf" + text; });
        with([](const auto& text) { return text.substr(0, text.size() - 1); });
        with([](const auto& text) { return text + std::string(5000, '\n'); });
        with([](const auto& text) { return text + "#" + std::string(20000, 'x'); });
        with([](const auto& text) { return replaced(text, "\n", "\n\t "); });
        with([](const auto& text) { return replaced(text, " ", " \t  "); });
    }
}

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
         medit(replaced(medit_points, "\nDimension 3", " Dimension 3") + cells + "End\n"), true,
         false},
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

TEST(ReadTogether, OddFilesComeToWhatOneProcessMakesOfThem) {
    for (const auto& cases : {odd_files(), odd_binary_files()}) {
        for (const Case& one : cases) {
            SCOPED_TRACE(one.name);
            EXPECT_EQ(are_read_together(one.files), one.together);
            EXPECT_EQ(expect_one_outcome(one.files), one.is_mesh);
        }
    }
}

TEST(ReadTogether, WhatIsNotThereIsMissedInTheWordsOfOneProcess) {
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

/// Inverted cells are turned round by one process, as it must say how many.
TEST(ReadTogether, InvertedCellsAreTurnedRoundIfAskedFor) {
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

TEST(ReadTogether, FilesThatWereChangedAtRandomComeToWhatOneProcessMakesOfThem) {
    const char* const given = std::getenv("OCTETRA_READING_SEED");
    std::vector<std::uint64_t> seed{given != nullptr ? std::strtoull(given, nullptr, 10)
                                                     : std::random_device()()};
    test::world().broadcast(seed);
    SCOPED_TRACE(fmt::format("OCTETRA_READING_SEED={}", seed.front()));
    std::mt19937_64 random(seed.front());
    const std::vector<Files> files{files_of(test::full_mesh(1, 0), ".ele"),
                                   files_of(test::full_mesh(1, 1), ".ele"),
                                   files_of(test::featured(test::full_mesh(1, 1), 3), ".mesh"),
                                   files_of(test::featured(test::full_mesh(1, 1), 3), ".meshb")};
    int meshes = 0;
    // Where there are more processes than cores, each turn takes long.
    const int turns = OCTETRA_SANITIZED ? 100 : test::world().size() > 3 ? 200 : 1000;
    for (int turn = 0; turn < turns; ++turn) {
        Files changed = files[random() % files.size()];
        std::string& text = changed.texts[random() % changed.texts.size()].second;
        text = mutated(std::move(text), random);
        if (expect_one_outcome(changed)) ++meshes;
        if (testing::Test::HasFailure()) {
            FAIL() << "turn " << turn << " of OCTETRA_READING_SEED=" << seed.front() << "\n"
                   << text;
        }
    }
    EXPECT_GT(meshes, 0);
    EXPECT_LT(meshes, turns);
}

}  // namespace
}  // namespace octetra
