#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <random>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "core/gathered_mesh.hpp"
#include "core/meshb_files.hpp"
#include "support/bits.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

/// stream_mesh() sends to a sink what read_mesh() with ReadOptions::only_syntax stores.
namespace octetra {
namespace {

namespace fs = std::filesystem;
using Gathered = test::CollectingSink;
using test::TemporaryFolder;
using testing::HasSubstr;

/// The result of reading a file: a mesh or an error, and notes.
struct Outcome {
    Mesh mesh;
    std::string error;
    std::vector<std::string> notes;
};

Outcome outcome_of(const std::function<Mesh(const ReadOptions&)>& read) {
    Outcome outcome;
    const auto note = [&](const std::string& text) { outcome.notes.push_back(text); };
    try {
        outcome.mesh = read({.only_syntax = true, .note = note});
    } catch (const InputError& error) {
        outcome.error = error.what();
    }
    return outcome;
}

/// Reads the file both ways, and compares.
void expect_streamed_as_read(const fs::path& file, Gathered& gathered) {
    SCOPED_TRACE(file);
    const Outcome read = outcome_of([&](const auto& options) { return read_mesh(file, options); });
    const Outcome streamed = outcome_of([&](const auto& options) {
        stream_mesh(file, gathered, options);
        return gathered.mesh;
    });
    EXPECT_EQ(streamed.error, read.error);
    EXPECT_EQ(gathered.is_finished, read.error.empty());
    if (!read.error.empty()) return;
    EXPECT_EQ(test::bits(streamed.mesh), test::bits(read.mesh));
    Mesh received = read.mesh;
    received.features = {};  // sinks do not receive them
    EXPECT_EQ(streamed.mesh, received);
    EXPECT_EQ(streamed.notes, read.notes);
}

std::vector<fs::path> corpus_files(const std::string& folder) {
    std::vector<fs::path> files;
    for (const auto& entry :
         fs::directory_iterator(fs::path(OCTETRA_SOURCE_DIR) / "corpus" / folder)) {
        files.push_back(entry.path());
    }
    std::ranges::sort(files);
    return files;
}

TEST(StreamedMesh, IsTheOneReadForEveryMeshOfTheCorpus) {
    const auto files = corpus_files("meshes");
    ASSERT_GE(files.size(), 40U);
    for (const fs::path& file : files) {
        Gathered gathered;
        expect_streamed_as_read(file, gathered);
    }
}

TEST(StreamedMesh, EndsInTheErrorOfReadingForEveryBadFileOfTheCorpus) {
    const auto files = corpus_files("bad");
    ASSERT_GE(files.size(), 80U);
    for (const fs::path& file : files) {
        Gathered gathered;
        expect_streamed_as_read(file, gathered);
    }
}

Marker random_marker(std::mt19937_64& random) { return static_cast<Marker>(random() % 7) - 3; }

/// Entities of each kind with arbitrary vertices, and each column present or not.
Mesh random_mesh(std::uint64_t seed, std::size_t size) {
    std::mt19937_64 random(seed);
    Mesh mesh;
    mesh.index_base = 1;
    const auto number = [&](std::size_t most) { return random() % (most + 1); };
    const std::size_t vertices = 1 + number(size);
    for (std::size_t v = 0; v < vertices; ++v) {
        mesh.points.push_back({static_cast<double>(random()), 0x1p-70 * 3, -1.0 / 3});
    }
    mesh.attributes_per_point = number(3);
    for (std::size_t i = 0; i < vertices * mesh.attributes_per_point; ++i) {
        mesh.point_attributes.push_back(static_cast<double>(i));
    }
    const auto fill = [&](auto& list, std::size_t count) {
        list.resize(count);
        for (auto& of_entity : list) {
            for (VertexIndex& v : of_entity) v = VertexIndex{random() % vertices};
        }
    };
    fill(mesh.cells, 1 + number(3 * size));
    fill(mesh.facets, number(2 * size));
    fill(mesh.edges, number(2 * size));
    const auto mark = [&](auto& markers, std::size_t count) {
        if (number(1) == 0) return;
        markers.resize(count);
        for (Marker& marker : markers) marker = random_marker(random);
    };
    mark(mesh.point_markers, vertices);
    mark(mesh.regions, mesh.cells.size());
    mark(mesh.facet_markers, mesh.facets.size());
    mark(mesh.edge_markers, mesh.edges.size());
    return mesh;
}

void write_all_kinds_of_msh(const Mesh& mesh, const TemporaryFolder& folder) {
    (void)write_mesh(mesh, folder / "4.msh");
    (void)write_mesh(mesh, folder / "4t.msh", {.msh = {.is_text = true}});
    (void)write_mesh(mesh, folder / "2.msh", {.msh = {.is_2 = true}});
    (void)write_mesh(mesh, folder / "2t.msh", {.msh = {.is_2 = true, .is_text = true}});
}

/// Shuffles the sections of a Medit file.
std::string shuffled_sections(const std::string& file, std::uint64_t seed) {
    std::vector<std::size_t> begins;
    for (const std::string keyword : {"\nVertices", "\nTetrahedra", "\nTriangles", "\nEdges"}) {
        const std::size_t begin = file.find(keyword);
        if (begin != std::string::npos) begins.push_back(begin);
    }
    std::ranges::sort(begins);
    std::vector<std::string> sections;
    for (std::size_t k = 0; k < begins.size(); ++k) {
        const std::size_t end = k + 1 < begins.size() ? begins[k + 1] : file.rfind("\nEnd");
        sections.push_back(file.substr(begins[k], end - begins[k]));
    }
    std::mt19937_64 random(seed);
    std::ranges::shuffle(sections, random);
    std::string result = file.substr(0, begins[0]);
    for (const std::string& section : sections) result += section;
    return result + "\nEnd\n";
}

TEST(StreamedMesh, IsTheOneReadForRandomMeshesInAnyOrderOfSections) {
    constexpr std::uint64_t first_seed = 1;
    for (std::uint64_t seed = first_seed; seed < first_seed + 12; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        const std::size_t size = seed % 3 == 0 ? MeshSink::max_batch_size : 20;
        const TemporaryFolder folder;
        const Mesh mesh = random_mesh(seed, size);
        (void)write_mesh(mesh, folder / "a.ele");
        (void)write_mesh(mesh, folder / "a.mesh");
        (void)write_mesh(mesh, folder / "a.meshb");
        const fs::path shuffled =
            folder.write("b.mesh", shuffled_sections(test::content_of(folder / "a.mesh"), seed));
        write_all_kinds_of_msh(mesh, folder);
        for (const fs::path& file :
             {folder / "a.ele", folder / "a.mesh", folder / "a.meshb", shuffled, folder / "4.msh",
              folder / "4t.msh", folder / "2.msh", folder / "2t.msh"}) {
            Gathered gathered;
            expect_streamed_as_read(file, gathered);
            EXPECT_EQ(gathered.mesh.cells, mesh.cells);
        }
    }
}

TEST(StreamedMesh, IsDeliveredInFullBlocks) {
    constexpr std::size_t longest = MeshSink::max_batch_size;
    Mesh mesh = test::one_cell(test::regular_corners);
    mesh.cells.resize(2 * longest + 1, mesh.cells.front());
    mesh.facets.resize(2 * longest, {VertexIndex{0}, VertexIndex{1}, VertexIndex{2}});
    mesh.points.resize(longest + 1);
    const TemporaryFolder folder;
    for (const std::string name : {"a.ele", "a.mesh", "a.meshb", "a.msh"}) {
        (void)write_mesh(mesh, folder / name);
        Gathered gathered;
        expect_streamed_as_read(folder / name, gathered);
        EXPECT_EQ(gathered.stretches, 2U + 3U + 2U) << name;
    }
    // With three attributes a block holds a fourth of the points.
    mesh.attributes_per_point = 3;
    mesh.point_attributes.resize(3 * mesh.points.size());
    (void)write_mesh(mesh, folder / "a.ele");
    Gathered gathered;
    expect_streamed_as_read(folder / "a.ele", gathered);
    EXPECT_EQ(gathered.stretches, 5U + 3U + 2U);
}

TEST(StreamedMesh, HasTheMarkersOfWhichOnlyTheFirstIsNotZero) {
    constexpr std::size_t several = MeshSink::max_batch_size + 1;
    Mesh mesh = test::one_cell(test::regular_corners);
    mesh.cells.resize(several, mesh.cells.front());
    mesh.points.resize(several);
    mesh.regions.resize(several);
    mesh.point_markers.resize(several);
    mesh.regions.front() = mesh.point_markers.front() = 1;
    const TemporaryFolder folder;
    (void)write_mesh(mesh, folder / "a.mesh");
    Gathered gathered;
    expect_streamed_as_read(folder / "a.mesh", gathered);
    EXPECT_EQ(gathered.mesh.regions, mesh.regions);
    EXPECT_EQ(gathered.mesh.point_markers, mesh.point_markers);
}

TEST(StreamedMesh, HasAdjacentCellsAtEachFaceIfAtTheFirst) {
    constexpr std::size_t longest = MeshSink::max_batch_size;
    const TemporaryFolder folder;
    (void)write_mesh(test::one_cell(test::regular_corners), folder / "a.ele");
    std::string faces = std::to_string(longest + 1) + " 1\n";
    for (std::size_t f = 0; f < longest; ++f) faces += std::to_string(f) + " 0 1 2 1 0 -1\n";
    for (const std::string last : {" 0 1 2 1 0 -1\n", " 0 1 2 1\n"}) {
        (void)folder.write("a.face", faces + std::to_string(longest) + last);
        Gathered gathered;
        expect_streamed_as_read(folder / "a.ele", gathered);
    }
}

/// A Medit file of four vertices and `count` cells, where entry `place` is `bad` (such as "1 2 3 9
/// 0"), followed by `tail`.
std::string medit_cells(std::size_t count, std::size_t place, const std::string& bad,
                        bool vertices_first, const std::string& tail) {
    const std::string vertices = "Vertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
    std::string cells = "Tetrahedra\n" + std::to_string(count) + "\n";
    for (std::size_t c = 0; c < count; ++c) cells += (c == place ? bad : "1 2 3 4 0") + "\n";
    return "MeshVersionFormatted 2\nDimension 3\n" +
           (vertices_first ? vertices + cells : cells + vertices) + tail;
}

TEST(StreamedMesh, StopsBeforeAVertexThatThereIsNotAndNamesItsLine) {
    constexpr std::size_t longest = MeshSink::max_batch_size;
    const TemporaryFolder folder;
    for (const bool vertices_first : {true, false}) {
        for (const std::string bad : {"1 2 5 9 0", "1 2\n5 9 0"}) {
            const fs::path file = folder.write(
                "a.mesh", medit_cells(3 * longest, longest + 5, bad, vertices_first, "End\n"));
            Gathered gathered;
            expect_streamed_as_read(file, gathered);
            EXPECT_EQ(gathered.mesh.cells.size(), longest);
            EXPECT_EQ(gathered.mesh.points.size(), 4U);
        }
    }
}

TEST(StreamedMesh, OfABinaryFileStopsBeforeAVertexThatThereIsNot) {
    constexpr std::size_t longest = MeshSink::max_batch_size;
    const TemporaryFolder folder;
    for (const bool vertices_first : {true, false}) {
        test::MeshbFile meshb;
        meshb.dimension();
        if (vertices_first) meshb.corner();
        meshb.section(8, 3 * longest);
        for (std::size_t c = 0; c < 3 * longest; ++c) {
            meshb.row({1, 2, 3, c == longest + 5 ? 9 : 4, 0});
        }
        if (!vertices_first) meshb.corner();
        Gathered gathered;
        expect_streamed_as_read(folder.write("a.meshb", meshb.end().bytes()), gathered);
        EXPECT_EQ(gathered.mesh.cells.size(), longest);
        EXPECT_EQ(gathered.mesh.points.size(), 4U);
    }
}

TEST(StreamedMesh, ReportsOfTwoErrorsTheOneThatReadingReports) {
    const TemporaryFolder folder;
    for (const bool vertices_first : {true, false}) {
        for (const std::string tail : {"Triangles\n1\n1 2 x 0\n", "Triangles\n1\n1 2 7 0\nEnd\n",
                                       "Edges 1 8 1 0 Triangles 1 1 2 7 0 End", "Nonsense"}) {
            for (const std::string cell : {"1 2 3 4 0", "1 2 3 6 0", "1 2 3 6 2.5"}) {
                const fs::path file =
                    folder.write("a.mesh", medit_cells(3, 1, cell, vertices_first, tail));
                Gathered gathered;
                expect_streamed_as_read(file, gathered);
                EXPECT_FALSE(gathered.is_finished);
            }
        }
    }
}

TEST(StreamedMesh, DeliversWholeBlocksOfATruncatedFile) {
    const TemporaryFolder folder;
    (void)write_mesh(test::kuhn(16, 16, 16), folder / "a.ele");
    const std::string whole = test::content_of(folder / "a.ele");
    const fs::path cut = folder.write("a.ele", whole.substr(0, whole.find("\n20000 ")));
    Gathered gathered;
    expect_streamed_as_read(cut, gathered);
    EXPECT_EQ(gathered.mesh.cells.size(), MeshSink::max_batch_size);
}

TEST(StreamedMesh, IsNotedOnceThoughItsFileIsReadTwice) {
    const TemporaryFolder folder;
    Gathered gathered;
    expect_streamed_as_read(folder.write("a.mesh", medit_cells(1, 0, "1 2 3 4 0", false, "")),
                            gathered);
}

/// Modifies a file while it is being read.
class ModifyingSink : public Gathered {
public:
    ModifyingSink(fs::path file, std::string from, std::string to)
        : file_(std::move(file)), from_(std::move(from)), to_(std::move(to)) {}

    void expect_points(std::uint64_t count, std::size_t attributes, bool has_markers) override {
        Gathered::expect_points(count, attributes, has_markers);
        const std::size_t place = test::content_of(file_).find(from_);
        std::fstream out(file_, std::ios::in | std::ios::out | std::ios::binary);
        out.seekp(static_cast<std::streamoff>(place));
        out << to_;
    }

private:
    fs::path file_;
    std::string from_;
    std::string to_;
};

TEST(StreamedMesh, MayNotLoseVerticesBetweenTwoReadings) {
    const TemporaryFolder folder;
    std::string text = medit_cells(1, 0, "1 2 3 4 0", false, "End\n");
    std::string padding;
    for (int i = 0; i < 40000; ++i)
        padding += "# what fills more than one buffer of the reader ...\n";
    text.insert(text.find("Vertices"), padding);
    const fs::path file = folder.write("a.mesh", text);
    ModifyingSink meddler(file, "Vertices\n4\n", "Vertices\n3\n");
    EXPECT_THAT(test::thrown_by<InputError>([&] { stream_mesh(file, meddler); }),
                HasSubstr("the file has changed while it was read"));
    EXPECT_FALSE(meddler.is_finished);
}

TEST(StreamedMesh, MayNotGainElementsBetweenTwoReadings) {
    const TemporaryFolder folder;
    const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
    std::string padding;
    for (int i = 0; i < 40000; ++i)
        padding += "# what fills more than one buffer of the reader ...\n";
    const fs::path file =
        folder.write("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + nodes + padding +
                                  "$Elements\n2\n1 4 0 1 2 3 4\n2 2 2 1 1 1 2 3\n$EndElements\n");
    ModifyingSink meddler(file, "2 2 2 1 1 1 2 3\n", "2 4 1 1 1 2 3 4\n");
    EXPECT_THAT(test::thrown_by<InputError>([&] { stream_mesh(file, meddler); }),
                HasSubstr("the file has changed while it was read"));
    EXPECT_FALSE(meddler.is_finished);
}

/// Nonconsecutive node tags, alternating kinds, and elements that are discarded.
TEST(StreamedMesh, IsTheOneReadOfAGmshFileInNoOrder) {
    const TemporaryFolder folder;
    std::mt19937_64 random(5);
    constexpr std::size_t vertices = 3000;
    std::vector<std::uint64_t> tags(vertices);
    for (std::size_t v = 0; v < vertices; ++v) tags[v] = 1 + 1000 * v + random() % 1000;
    std::ranges::shuffle(tags, random);
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3000\n";
    for (const std::uint64_t tag : tags) text += fmt::format("{} 1 2 3\n", tag);
    text += "$EndNodes\n$Periodic\n$EndPeriodic\n$Elements\n60000\n";
    constexpr std::array<std::size_t, 16> nodes{0, 2, 3, 4, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
    for (int e = 1; e <= 60000; ++e) {
        const std::size_t type = std::array<std::size_t, 5>{1, 2, 3, 4, 15}[random() % 5];
        text += fmt::format("{} {} 2 {} 1", e, type, random() % 3);
        for (std::size_t k = 0; k < nodes[type]; ++k) {
            text += fmt::format(" {}", tags[random() % vertices]);
        }
        text += "\n";
    }
    Gathered gathered;
    expect_streamed_as_read(folder.write("a.msh", text + "$EndElements\n"), gathered);
    EXPECT_GT(gathered.mesh.cells.size(), 11000U);
}

TEST(StreamedMesh, IsOfAFormatThatCanBeRead) {
    for (const std::string name : {"a.vtu", "a.pvtu", "a.vtkhdf", "a.stl"}) {
        Gathered gathered;
        expect_streamed_as_read(name, gathered);
        EXPECT_FALSE(gathered.is_finished);
    }
}

TEST(StreamedMesh, ThrowsTheErrorOfTheSink) {
    struct Refusing : Gathered {
        void take_cells(std::span<const CellVertices>, std::span<const Marker>) override {
            throw SystemError("no room");
        }
    };
    const TemporaryFolder folder;
    for (const std::string name : {"a.ele", "a.mesh", "a.meshb", "a.msh"}) {
        (void)write_mesh(test::kuhn(1, 1, 1), folder / name);
        Refusing sink;
        EXPECT_THROW(stream_mesh(folder / name, sink), SystemError);
        EXPECT_FALSE(sink.is_finished);
    }
}

}  // namespace
}  // namespace octetra
