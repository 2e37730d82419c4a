#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "core/mesh_shares.hpp"
#include "core/meshb_files.hpp"
#include "core/refused_files.hpp"
#include "files/medit/medit.hpp"
#include "support/bits.hpp"
#include "support/meshes.hpp"
#include "support/tagged_meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

namespace octetra {
namespace {

using test::MeshbFile;
using test::RefusedFiles;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

MeshbFile meshb_start(int version = 2, bool swapped = false) {
    return std::move(MeshbFile(version, swapped).dimension());
}
MeshbFile corner(int version = 2) { return std::move(meshb_start(version).corner()); }

Mesh read_bytes(const std::string& bytes, const ReadOptions& options = {}) {
    return test::read_content("m.meshb", bytes, options);
}

/// One cell, a triangle and an edge, all with tags, read from the text format.
Mesh tagged_cell() {
    const TemporaryFolder folder;
    return read_mesh(folder.write("m.mesh",
                                  "MeshVersionFormatted 2 Dimension 3 Vertices 4 0 0 0 7 1 0 0 0 "
                                  "0 1 0 0 0 0 1 -2 Tetrahedra 1 1 2 3 4 5 Triangles 1 1 2 3 -3 "
                                  "Edges 1 4 1 2147483647 End"));
}

TEST(MeshbReader, TakesEveryVersionInEitherByteOrder) {
    for (const int version : {1, 2, 3, 4}) {
        for (const bool swapped : {false, true}) {
            SCOPED_TRACE(testing::Message() << "version " << version << ", swapped " << swapped);
            MeshbFile file = meshb_start(version, swapped);
            file.corner().cell();
            file.section(6, 1).row({1, 2, 3, -3}).section(5, 1).row({4, 1, 2147483647}).end();
            EXPECT_EQ(read_bytes(file.bytes()), tagged_cell());
        }
    }
}

TEST(MeshbReader, TakesSectionsInAnyOrder) {
    MeshbFile file(3);
    file.section(5, 1).row({4, 1, 2147483647}).section(6, 1).row({1, 2, 3, -3});
    file.cell().dimension().corner().end();
    EXPECT_EQ(read_bytes(file.bytes()), tagged_cell());
}

TEST(MeshbReader, TakesEveryEndThatProgramsWrite) {
    const Mesh expected = read_bytes(MeshbFile(corner()).cell().end().bytes());
    std::string note;
    const ReadOptions options{.note = [&](const auto& n) { note += n; }};
    const MeshbFile whole = MeshbFile(corner()).cell().end();
    const std::string bytes = whole.bytes();
    EXPECT_EQ(read_bytes(bytes.substr(0, bytes.size() - 4), options), expected);  // no position
    EXPECT_EQ(read_bytes(MeshbFile(whole).set_next(bytes.size()).bytes(), options), expected);
    EXPECT_EQ(note, "");
    EXPECT_EQ(read_bytes(MeshbFile(corner()).cell().bytes(), options),
              expected);  // the next position is 0
    EXPECT_THAT(note, HasSubstr("without the keyword End"));
    note.clear();
    EXPECT_EQ(read_bytes(bytes.substr(0, bytes.size() - 8), options), expected);  // cut off
    EXPECT_THAT(note, HasSubstr("without the keyword End"));
}

TEST(MeshbReader, SkipsUnsupportedSectionsWithANote) {
    MeshbFile file = corner();
    const std::size_t normals_at = file.size();
    file.section(20, 2).row({1, 1, 2, 1});
    const std::size_t box_at = file.size();
    file.keyword(50).real(0).real(0).real(0).real(1).real(1).real(1);
    file.section(14, 0)
        .section(10, 0)
        .cell()
        .section(60, 1)
        .real(0)
        .real(not_a_number)
        .real(1)
        .end();
    std::vector<std::string> notes;
    EXPECT_EQ(read_bytes(file.bytes(), {.note = [&](const auto& n) { notes.push_back(n); }}),
              read_bytes(MeshbFile(corner()).cell().end().bytes()));
    const auto at = [](std::size_t byte) { return "m.meshb: at byte " + std::to_string(byte); };
    EXPECT_THAT(
        notes,
        ElementsAre(HasSubstr(at(normals_at) + ": the 2 entries of NormalAtVertices are not kept"),
                    HasSubstr(at(box_at) + ": the section with keyword 50 is not kept"),
                    HasSubstr("the 1 entries of Normals are not kept")));
}

TEST(MeshbReader, DropsReferencesThatAreAllZero) {
    MeshbFile file = meshb_start();
    file.section(4, 4);
    for (const double k : {0.0, 1.0, 2.0, 3.0}) file.point(k == 1, k == 2, k == 3, 0);
    const Mesh mesh = read_bytes(file.section(8, 1).row({1, 2, 3, 4, 0}).end().bytes());
    EXPECT_TRUE(mesh.point_markers.empty());
    EXPECT_TRUE(mesh.regions.empty());
    EXPECT_EQ(mesh.index_base, 1U);
}

TEST(MeshbReader, CorrectsInvertedCellsIfRequested) {
    const std::string bytes = corner().section(8, 1).row({2, 1, 3, 4, 0}).end().bytes();
    EXPECT_THROW((void)read_bytes(bytes), InputError);
    EXPECT_EQ(read_bytes(bytes, {.fix_orientation = true}).cells.front(),
              (CellVertices{VertexIndex{1}, VertexIndex{0}, VertexIndex{3}, VertexIndex{2}}));
}

using Row = test::Refusal<std::string>;

/// A file whose fault is `back` bytes before its end.
Row bad(const std::string& name, const MeshbFile& file, std::size_t back, const std::string& what) {
    return {name, file.bytes(), test::at_byte(file.size() - back), what};
}

std::vector<Row> bad_bytes() {
    const auto bytes_of = [](auto number, auto... numbers) {
        MeshbFile file;
        file.put(number);
        (file.put(numbers), ...);
        return file.bytes().substr(8);
    };
    const MeshbFile cell = MeshbFile(corner()).cell();
    MeshbFile many = corner();
    for (int k = 0; k < 1000; ++k) many.section(20, 0);
    return {
        {"Empty", "", test::at_byte(0), "the file ends where the number 1 should be"},
        {"Text", "MeshVersionFormatted 2\n", test::at_byte(0), "text file: name it .mesh"},
        {"OfMfem", "MFEM mesh v1.0\n", test::at_byte(0), "this is a mesh of MFEM; of .meshb files"},
        {"Begin", "Nothing of the kind\n", test::at_byte(0), "begins with the number 1"},
        {"OnlyOne", bytes_of(std::int32_t{1}), test::at_byte(4),
         "ends where the format's version should be"},
        {"VersionZero", bytes_of(std::int32_t{1}, std::int32_t{0}), test::at_byte(4),
         "versions 1 to 4, not 0"},
        {"VersionFive", bytes_of(std::int32_t{1}, std::int32_t{5}), test::at_byte(4),
         "versions 1 to 4, not 5"},
        {"OnlyHead", meshb_start().bytes(), test::at_byte(20), "no section Vertices"},
        {"DimensionTwo", MeshbFile().dimension(2).bytes(), test::at_byte(16),
         "dimension 3 expected, 2 found"},
        {"InKeyword", MeshbFile(cell).end().bytes().substr(0, cell.size() + 3),
         test::at_byte(cell.size()), "the file ends where a keyword should be"},
        // Positions relative to the end of the file: keyword, position and count have 4 bytes each.
        bad("Unknown", MeshbFile(cell).section(0, 3), 12, "a keyword expected, 0 found"),
        bad("Negative", MeshbFile(cell).section(-8, 3), 12, "a keyword expected, -8 found"),
        bad("FarCode", MeshbFile(cell).section(70000, 3), 12, "a keyword expected, 70000"),
        bad("BehindEnd", MeshbFile(cell).end().put('x'), 1, "extra bytes after the keyword End"),
        bad("KeywordBehindEnd", MeshbFile(cell).end().set_next(8), 4, "after End is said to be"),
        bad("SecondOrder", MeshbFile(cell).section(30, 0), 12, "elements (TetrahedraP2)"),
        bad("Hexahedra", MeshbFile(cell).section(10, 1), 12, "and this one has Hexahedra"),
        bad("ThirdOrder", MeshbFile(cell).section(96, 1), 12, "has cells with keyword 96"),
        bad("TwoSections", MeshbFile(cell).corner(), 124, "vertices; the first is at byte 20"),
        bad("CountHuge", meshb_start().section(4, 2000000000), 4, "hold at most 0"),
        bad("CountNegative", meshb_start().section(4, -1), 4, "should be from 0, not -1"),
        bad("CountThatOverflows", meshb_start(4).section(4, (1LL << 60) + 1), 8, "at most 0"),
        bad("CountTooLarge", corner().section(8, 2).row({1, 2, 3, 4, 5}), 24,
            "2 tetrahedra announced, but the 20 bytes that follow hold at most 1"),
        bad("CountTooSmall", corner().section(8, 0).row({1, 2, 3, 4, 5}), 24,
            "0 tetrahedra announced, which end at byte 156, but the next keyword is said to be at"),
        bad("SkippedCountTooLarge", MeshbFile(cell).section(13, 2).row({1}), 8, "hold at most 1"),
        bad("ItselfNext", corner().section(5, 0).set_next(144), 8,
            "the next keyword is said to be at byte 144, before this one's end"),
        bad("Backwards", corner().section(5, 0).set_next(20), 8, "before this one's"),
        bad("BeforeTheFile", corner().section(5, 0).set_next(~std::size_t{0}), 8,
            "said to be at byte -1"),
        bad("BehindTheFile", corner().section(5, 0).set_next(157), 8,
            "said to be at byte 157, but the file has 156"),
        bad("FarBehindTheFile", meshb_start(3).section(4, 0).set_next(std::size_t{1} << 62U), 12,
            "but the file has 40"),
        {"BetweenKeywords", corner().put('x').section(8, 1).row({1, 2, 3, 4, 5}).bytes(),
         test::at_byte(28),
         "which end at byte 144, but the next keyword is said to be at byte 145"},
        // Rows of vertices have 28 bytes, those of cells 20.
        bad("NaN", meshb_start().section(4, 1).point(0, not_a_number, 0, 0), 28,
            "vertex 1 of this section: y is not finite: nan"),
        bad("Infinite", meshb_start(1).section(4, 1).point(HUGE_VAL, 0, 0, 0), 16,
            "x is not finite: inf"),
        bad("BeyondMidpoints", meshb_start().section(4, 1).point(0, 0, -9e307, 0), 28,
            "z is -9e+307: coordinates must be less than 2^1023"),
        bad("FarReference", meshb_start(4).section(4, 1).point(0, 0, 0, 1LL << 31U), 32,
            "the vertex's reference should be a whole number of 32 bits, not 2147483648"),
        bad("FarRegion", corner(4).section(8, 1).row({1, 2, 3, 4, -(1LL << 31U) - 1}), 40,
            "the reference should be a whole number of 32 bits, not -2147483649"),
        bad("VertexZero", corner().section(8, 1).row({1, 0, 3, 4, 5}), 20,
            "cell 1 of this section: there is no vertex 0"),
        bad("VertexNegative", corner().section(8, 1).row({1, 2, 3, -4, 5}), 20,
            "there is no vertex -4"),
        bad("VertexTooLarge", corner().section(8, 1).row({1, 2, 3, 5, 5}), 20,
            "there is no vertex 5: the file has 4"),
        bad("VertexFar", corner(4).section(8, 1).row({1, 2, 3, (1LL << 32U) + 1, 5}), 40,
            "there is no vertex 4294967297"),
        bad("VertexTwice", MeshbFile(cell).section(6, 2).row({1, 2, 3, 0}).row({1, 3, 3, 0}), 16,
            "triangle 2 of this section: the triangle has the same vertex twice"),
        bad("Inverted", corner().section(8, 1).row({2, 1, 3, 4, 5}), 20, "inverted"),
        bad("CellTwice", corner().section(8, 2).row({1, 2, 3, 4, 5}).row({2, 3, 1, 4, 5}), 20,
            "cell 2 has the vertices of cell 1"),
        bad("StrayEdge", MeshbFile(cell).section(5, 2).row({1, 2, 9}).row({2, 1, 8}), 12,
            "edge 2 with marker 8 is listed already, with marker 9, as edge 1"),
        {"ManyKeywords", many.bytes(), test::at_byte(144 + 998 * 12), "more than 1000 keywords"},
    };
}

INSTANTIATE_TEST_SUITE_P(Meshb, RefusedFiles,
                         test::refusals(
                             "m.meshb", +[](const std::string& bytes) { (void)read_bytes(bytes); },
                             bad_bytes()),
                         test::name_of_case);

/// The first bad entry of several hundred thousand, far beyond the first buffer.
TEST(MeshbReader, NamesTheByteOfAnEntryFarBehind) {
    constexpr std::int64_t count = 100'000;
    constexpr std::int64_t bad = 77'777;
    MeshbFile file = meshb_start(4);
    file.section(4, count);
    const std::size_t rows_at = file.size();
    for (std::int64_t v = 0; v < count; ++v) file.point(0, v >= bad ? not_a_number : 1, 0, 0);
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_bytes(file.end().bytes()); }),
                HasSubstr("at byte " + std::to_string(rows_at + 32 * bad) + ": vertex " +
                          std::to_string(bad + 1) + " of this section: y is not"));
}

TEST(MeshbVersion, IsTheLowestThatHoldsTheMesh) {
    constexpr std::uint64_t most = 2147483647;
    EXPECT_EQ(meshb_version({}), 2);
    // 20 bytes of head, 12 of the head of each section, 8 of the end.
    constexpr std::uint64_t vertices = (most - 20 - 2 * 12 - 8) / 28;
    EXPECT_EQ(meshb_version({.vertices = vertices}), 2);
    EXPECT_EQ(meshb_version({.vertices = vertices + 1}), 3);
    EXPECT_EQ(meshb_version({.vertices = most, .cells = most}), 3);
    EXPECT_EQ(meshb_version({.vertices = most + 1, .cells = 1}), 4);
    EXPECT_EQ(meshb_version({.vertices = 1, .cells = most + 1}), 4);
}

Mesh mesh_with_tags() {
    Mesh mesh = test::perturbed_kuhn(5, 0.2, 3);
    test::list_boundary(mesh);
    mesh.regions.resize(mesh.cells.size());
    mesh.edges.append({mesh.cells.front()[0], mesh.cells.front()[1]});
    mesh.edge_markers.append(9);
    mesh.regions.back() = std::numeric_limits<Marker>::min();
    mesh.index_base = 1;
    return mesh;
}

TEST(MeshbWriter, WritesEveryVersionSoThatItReadsBackToTheSameBits) {
    const TemporaryFolder folder;
    const Mesh mesh = mesh_with_tags();
    for (const std::int32_t version : {2, 3, 4}) {
        WholeMesh source(mesh);
        EXPECT_EQ(write_meshb(source, folder / "a.meshb", version), "");
        const std::string bytes = test::content_of(folder / "a.meshb");
        EXPECT_EQ(bytes[0], 1);
        EXPECT_EQ(bytes[4], version);
        const Mesh again = read_bytes(bytes);
        EXPECT_EQ(again, mesh);
        EXPECT_EQ(test::bits(again), test::bits(mesh));
    }
}

TEST(MeshbWriter, WritesTheBytesThatTheFormatAsksFor) {
    const TemporaryFolder folder;
    (void)write_mesh(tagged_cell(), folder / "a.meshb");
    MeshbFile expected = meshb_start();
    expected.corner().cell().section(6, 1).row({1, 2, 3, -3}).section(5, 1);
    expected.row({4, 1, 2147483647}).end();
    EXPECT_EQ(test::content_of(folder / "a.meshb"), expected.bytes());
}

/// All processes together write the same bytes as one, slice by slice.
TEST(MeshbWriter, WritesTheSameBytesAsTheTextReadBack) {
    const TemporaryFolder folder;
    const Mesh mesh = test::kuhn(20, 20, 20, 1.0 / 3);  // several blocks of a writer
    (void)write_mesh(mesh, folder / "a.mesh");
    (void)write_mesh(mesh, folder / "a.meshb");
    EXPECT_TRUE(read_mesh(folder / "a.meshb") == read_mesh(folder / "a.mesh"));
    (void)write_mesh(read_mesh(folder / "a.mesh"), folder / "b.meshb");
    EXPECT_TRUE(test::content_of(folder / "a.meshb") == test::content_of(folder / "b.meshb"));
}

std::uint64_t meshb_seed() {
    const char* const given = std::getenv("OCTETRA_MESHB_SEED");
    return given != nullptr ? std::strtoull(given, nullptr, 10) : std::random_device()();
}

/// Files with random bytes, and truncated files: a mesh or a refusal, the same for all ways of
/// reading.
TEST(MeshbReader, MakesAMeshOrARefusalOfWhateverIsThere) {
    const std::uint64_t seed = meshb_seed();
    SCOPED_TRACE(testing::Message() << "OCTETRA_MESHB_SEED=" << seed);
    std::mt19937_64 random(seed);
    const TemporaryFolder folder;
    std::vector<std::string> files;
    for (const std::int32_t version : {2, 3, 4}) {
        const Mesh mesh = mesh_with_tags();
        WholeMesh source(mesh);
        (void)write_meshb(source, folder / "a.meshb", version);
        files.push_back(test::content_of(folder / "a.meshb"));
        files.push_back(MeshbFile(corner(version)).cell().section(13, 1).row({1}).end().bytes());
    }
    int meshes = 0;
    constexpr int turns = OCTETRA_SANITIZED ? 150 : 300;
    for (int turn = 0; turn < turns; ++turn) {
        std::string bytes = files[random() % files.size()];
        const std::size_t early = random() % 2 == 0 ? bytes.size() : 60;
        bytes[random() % early] = static_cast<char>(random());
        if (random() % 4 == 0) bytes.resize(random() % bytes.size());
        const auto file = folder.write("m.meshb", bytes);
        try {
            (void)read_mesh(file);
            ++meshes;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::StartsWith(file.native() + ": at byte "));
        }
        test::expect_correct_shares(file);
        if (HasFailure()) FAIL() << "turn " << turn;
    }
    EXPECT_GT(meshes, 0);
    EXPECT_LT(meshes, turns);
}

}  // namespace
}  // namespace octetra
