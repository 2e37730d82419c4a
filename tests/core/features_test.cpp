#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "core/mesh_shares.hpp"
#include "core/meshb_files.hpp"
#include "support/discarding_sink.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

/// Corners, ridges and required entities in Medit files.
namespace octetra {
namespace {

using test::DiscardingSink;
using test::MeshbFile;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

/// A cell with two listed triangles and three listed edges.
MeshbFile listed_cell(int version = 2, bool swapped = false) {
    MeshbFile file = MeshbFile(version, swapped).dimension().corner().cell();
    file.section(6, 2).row({1, 2, 3, 1, 1, 2, 4, 1});
    return std::move(file.section(5, 3).row({1, 2, 1, 1, 3, 1, 1, 4, 1}));
}

Mesh read_file(const std::string& name, const std::string& content) {
    const TemporaryFolder folder;
    const auto file = folder.write(name, content);
    test::expect_correct_shares(file);
    return read_mesh(file);
}

const std::string head_of_text =
    "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 7\n1 0 0 0\n0 1 0 0\n0 0 1 -2\n"
    "Tetrahedra\n1\n1 2 3 4 5\nTriangles\n2\n1 2 3 1\n1 2 4 1\nEdges\n3\n1 2 1\n1 3 1\n1 4 1\n";

Mesh featured_cell() {
    Mesh mesh = read_file("m.mesh", head_of_text + "End\n");
    mesh.features[Feature::corners] = {0, 1, 3};
    mesh.features[Feature::required_vertices] = {2};
    mesh.features[Feature::ridges] = {0, 2};
    mesh.features[Feature::required_edges] = {1};
    mesh.features[Feature::required_facets] = {0, 1};
    mesh.features[Feature::required_cells] = {0};
    return mesh;
}

TEST(Features, OfTextAreReadInAnyOrderAndOnceEach) {
    EXPECT_EQ(
        read_file("m.mesh",
                  head_of_text +
                      "RequiredTetrahedra\n1\n1\nRequiredTriangles\n3\n2\n1\n2\nRidges\n2\n3\n"
                      "1\nRequiredEdges\n1\n2\nCorners\n4\n4\n2\n1\n4\n"
                      "RequiredVertices\n1\n3\nEnd\n"),
        featured_cell());
    // In scattered sections, which precede the entities that they refer to.
    std::string text = head_of_text;
    text.insert(text.find("Vertices"),
                "Corners 3 1 2\n4 Ridges 2 1 3 RequiredEdges 1 2 RequiredVertices 1 3 "
                "RequiredTriangles 2 1 2 RequiredTetrahedra 1\n1\n");
    EXPECT_EQ(read_file("m.mesh", text + "End\n"), featured_cell());
}

TEST(Features, OfBinaryFilesAreReadInEveryVersionAndByteOrder) {
    for (const int version : {1, 2, 3, 4}) {
        for (const bool swapped : {false, true}) {
            MeshbFile file = listed_cell(version, swapped);
            file.section(12, 1).row({1}).section(17, 3).row({2, 1, 2}).section(14, 2).row({3, 1});
            file.section(16, 1).row({2}).section(13, 4).row({4, 2, 1, 4}).section(15, 1).row({3});
            EXPECT_EQ(read_file("m.meshb", file.end().bytes()), featured_cell())
                << version << ' ' << swapped;
        }
    }
}

TEST(Features, AreReadBackAsTheyWereWritten) {
    const TemporaryFolder folder;
    for (const std::string name : {"a.mesh", "a.meshb"}) {
        EXPECT_EQ(write_mesh(featured_cell(), folder / name), "");
        EXPECT_EQ(read_mesh(folder / name), featured_cell()) << name;
        test::expect_correct_shares(folder / name);
    }
    EXPECT_THAT(
        test::content_of(folder / "a.mesh"),
        HasSubstr("Edges\n3\n1 2 1\n1 3 1\n1 4 1\nCorners\n3\n1\n2\n4\nRequiredVertices\n1\n"
                  "3\nRidges\n2\n1\n3\nRequiredEdges\n1\n2\nRequiredTriangles\n2\n1\n2\n"
                  "RequiredTetrahedra\n1\n1\nEnd\n"));
    MeshbFile expected = listed_cell();
    expected.section(13, 3).row({1, 2, 4}).section(15, 1).row({3}).section(14, 2).row({1, 3});
    expected.section(16, 1).row({2}).section(17, 2).row({1, 2}).section(12, 1).row({1}).end();
    EXPECT_EQ(test::content_of(folder / "a.meshb"), expected.bytes());
}

/// Several blocks of a writer.
TEST(Features, OfAMeshInManySlicesAreReadBack) {
    Mesh mesh = test::kuhn(16, 16, 16);
    mesh.index_base = 1;
    for (std::uint64_t c = 0; c < mesh.cells.size(); c += 1 + c % 2) {
        mesh.features[Feature::required_cells].push_back(c);
    }
    for (std::uint64_t v = 0; v < mesh.points.size(); v += 3) {
        mesh.features[Feature::corners].push_back(v);
    }
    const TemporaryFolder folder;
    for (const std::string name : {"a.mesh", "a.meshb"}) {
        (void)write_mesh(mesh, folder / name);
        EXPECT_TRUE(read_mesh(folder / name) == mesh) << name;
        test::expect_correct_shares(folder / name);
    }
}

TEST(Features, ThatAFormatCannotHoldAreNoted) {
    const TemporaryFolder folder;
    for (const std::string name : {"a.ele", "a.msh", "a.vtu", "a.pvtu", "a.vtkhdf", "a.xdmf"}) {
        EXPECT_THAT(write_mesh(featured_cell(), folder / name),
                    HasSubstr("corners, ridges and required entities are lost"))
            << name;
    }
}

struct BadRows {
    std::string what;
    std::function<void(MeshbFile&)> put;
};

TEST(Features, OfBinaryFilesAreRefusedByTheByteWhereTheyAreWrong) {
    const std::vector<BadRows> cases{
        {"entry 2 of Corners: there is no vertex 5: the file has 4",
         [](MeshbFile& f) {
             f.section(13, 2).row({1, 5});
         }},
        {"entry 2 of RequiredVertices: there is no vertex 0: the file has 4",
         [](MeshbFile& f) {
             f.section(15, 2).row({1, 0});
         }},
        {"entry 2 of Ridges: there is no edge 4: the file has 3",
         [](MeshbFile& f) {
             f.section(14, 2).row({1, 4});
         }},
        {"entry 2 of RequiredEdges: there is no edge -1: the file has 3",
         [](MeshbFile& f) {
             f.section(16, 2).row({1, -1});
         }},
        {"entry 2 of RequiredTriangles: there is no triangle 2147483647: the file has 2",
         [](MeshbFile& f) {
             f.section(17, 2).row({2, 2147483647});
         }},
        {"entry 2 of RequiredTetrahedra: there is no cell 2: the file has 1",
         [](MeshbFile& f) {
             f.section(12, 2).row({1, 2});
         }},
    };
    for (const int version : {2, 3, 4}) {
        for (const BadRows& bad : cases) {
            MeshbFile file = listed_cell(version);
            bad.put(file);
            const std::size_t last = file.size() - (version < 4 ? 4 : 8);
            EXPECT_THAT(test::thrown_by<InputError>(
                            [&] { (void)read_file("m.meshb", file.end().bytes()); }),
                        HasSubstr("m.meshb: at byte " + std::to_string(last) + ": " + bad.what));
        }
    }
}

TEST(Features, AreNotReadFromMoreBytesThanThereAre) {
    MeshbFile many = listed_cell();
    const std::size_t at = many.size();
    many.section(13, 2000000000).row({1}).end();
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_file("m.meshb", many.bytes()); }),
                HasSubstr("m.meshb: at byte " + std::to_string(at + 8) + ": "));
    MeshbFile fewer = listed_cell();
    fewer.section(13, 1).row({1, 2}).end();
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_file("m.meshb", fewer.bytes()); }),
                HasSubstr("1 Corners announced"));
    MeshbFile twice = listed_cell();
    twice.section(13, 1).row({1}).section(13, 1).row({2}).end();
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_file("m.meshb", twice.bytes()); }),
                HasSubstr("a second section of Corners"));
}

TEST(Features, AreRefusedWithTheSameMessageWhereAMeshIsStreamed) {
    const TemporaryFolder folder;
    for (const std::string section : {"Corners\n2\n1\n5\n", "Ridges\n1\n4\n", "Corners\n1\n0\n"}) {
        std::string early = head_of_text;
        early.insert(early.find("Vertices"), section);
        for (const std::string& text : {head_of_text + section, early}) {
            const auto file = folder.write("m.mesh", text + "End\n");
            DiscardingSink sink;
            EXPECT_EQ(test::thrown_by<InputError>([&] { stream_mesh(file, sink); }),
                      test::thrown_by<InputError>([&] { (void)read_mesh(file); }));
        }
    }
    const auto good = folder.write("m.mesh", head_of_text + "Corners\n1\n4\nEnd\n");
    DiscardingSink sink;
    EXPECT_NO_THROW(stream_mesh(good, sink));
}

}  // namespace
}  // namespace octetra
