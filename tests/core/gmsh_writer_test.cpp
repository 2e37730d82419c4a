#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "core/gmsh_files.hpp"
#include "core/mesh_shares.hpp"
#include "support/bits.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"
#include "verify/thread_group.hpp"

/// Writing of Gmsh files, which are read again.
namespace octetra {
namespace {

using test::content_of;
using test::TemporaryFolder;
using testing::HasSubstr;

constexpr std::array<MshFormat, 4> all_formats{
    {{false, false}, {false, true}, {true, false}, {true, true}}};

std::string kind_of(const MshFormat& format) {
    return std::string(format.is_2 ? "2.2 " : "4.1 ") + (format.is_text ? "text" : "binary");
}

/// A mesh with everything that these files can contain.
Mesh rich_mesh() {
    Mesh mesh = test::perturbed_kuhn(3, 0.2, 3);
    test::list_boundary(mesh);
    mesh.index_base = 1;
    mesh.group_names = {{3, 1, "rock # 1"},
                        {2, -5, "\"outer\" wall"},
                        {0, 9,
                         "Stra\xc3\x9f"
                         "e"}};
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        mesh.regions.append(static_cast<Marker>(c.value() / 7 % 3) - 1);
    }
    for (const auto& [i, j] : cell_edges) {
        mesh.edges.append({mesh.cells[CellIndex{0}][i], mesh.cells[CellIndex{0}][j]});
        mesh.edge_markers.append(static_cast<Marker>(10 * i + j));
    }
    return mesh;
}

Mesh through_file(const Mesh& mesh, const MshFormat& format) {
    const TemporaryFolder folder;
    (void)write_mesh(mesh, folder / "a.msh", {.msh = format});
    test::expect_correct_shares(folder / "a.msh");
    return read_mesh(folder / "a.msh");
}

TEST(GmshRoundTrip, KeepsGroupsOrderAndEveryBit) {
    Mesh plain = rich_mesh();
    plain.regions.clear();
    plain.facet_markers.clear();
    plain.edge_markers.clear();
    Mesh cells_alone = test::kuhn(2, 2, 2, 1.0 / 3);
    cells_alone.index_base = 1;
    Mesh points_alone = cells_alone;
    points_alone.cells.clear();
    for (const MshFormat& format : all_formats) {
        SCOPED_TRACE(kind_of(format));
        for (const Mesh& mesh : {rich_mesh(), plain, cells_alone, points_alone, Mesh{}}) {
            const Mesh read = through_file(mesh, format);
            EXPECT_EQ(read, mesh);
            EXPECT_EQ(test::bits(read), test::bits(mesh));
        }
    }
}

TEST(GmshRoundTrip, KeepsExtremeCoordinates) {
    const Mesh mesh = test::extreme_cell();
    for (const MshFormat& format : all_formats) {
        EXPECT_EQ(test::bits(through_file(mesh, format)), test::bits(mesh)) << kind_of(format);
    }
}

/// Markers that change at random, rarely or at every entity.
void mark_at_random(IndexVector<CellIndex, Marker>& markers, std::size_t count, std::uint64_t often,
                    std::mt19937_64& random) {
    Marker marker = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (random() % often == 0) marker = static_cast<Marker>(random() % 5) - 1;
        markers.push_back(marker);
    }
}

/// A mesh divided into slices, as seen by one of several processes.
class SlicedMesh final : public MeshSource {
public:
    SlicedMesh(const Mesh& mesh, const ProcessGroup& group) : whole_(mesh), group_(&group) {}

    [[nodiscard]] const MeshFacts& facts() const override { return whole_.facts(); }
    [[nodiscard]] const ProcessGroup& group() const override { return *group_; }
    [[nodiscard]] std::span<const Point> points(const Window& w) override {
        return whole_.points(own(w));
    }
    [[nodiscard]] std::span<const VertexNumbers<4>> cells(const Window& w) override {
        return whole_.cells(own(w));
    }
    [[nodiscard]] std::span<const Marker> regions(const Window& w) override {
        return whole_.regions(own(w));
    }
    [[nodiscard]] std::span<const VertexNumbers<3>> facets(const Window& w) override {
        return whole_.facets(own(w));
    }
    [[nodiscard]] std::span<const Marker> facet_markers(const Window& w) override {
        return whole_.facet_markers(own(w));
    }
    [[nodiscard]] std::span<const VertexNumbers<2>> edges(const Window& w) override {
        return whole_.edges(own(w));
    }
    [[nodiscard]] std::span<const Marker> edge_markers(const Window& w) override {
        return whole_.edge_markers(own(w));
    }

private:
    [[nodiscard]] Window own(const Window& window) const {
        return {window.begin_of(group_->rank()), window.slice_length, window.count};
    }

    WholeMesh whole_;
    const ProcessGroup* group_;
};

TEST(GmshWriter, WritesTheSameBytesOnAnyNumberOfProcesses) {
    constexpr std::uint64_t first_seed = 1;
    for (std::uint64_t seed = first_seed; seed < first_seed + 12; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937_64 random(seed);
        Mesh mesh = rich_mesh();
        if (seed % 4 == 3) mesh.regions.clear();
        if (seed % 4 == 1) {
            mesh.cells = test::kuhn(24, 24, 24).cells;
            mesh.points = test::kuhn(24, 24, 24).points;
        }
        if (seed % 4 != 3) {
            mesh.regions.clear();
            mark_at_random(mesh.regions, mesh.cells.size(), 1 + random() % 40, random);
        }
        const TemporaryFolder folder;
        for (const MshFormat& format : all_formats) {
            (void)write_mesh(mesh, folder / "one.msh", {.msh = format});
            for (const int size : {2, 3, 7}) {
                test::run_together(size, [&](const ProcessGroup& group) {
                    SlicedMesh sliced(mesh, group);
                    (void)write_mesh(sliced, folder / "all.msh", {.msh = format});
                });
                EXPECT_TRUE(content_of(folder / "all.msh") == content_of(folder / "one.msh"))
                    << size << " " << kind_of(format);
            }
        }
        EXPECT_TRUE(read_mesh(folder / "all.msh", {.only_syntax = true}).regions == mesh.regions ||
                    mesh.regions.empty());
    }
}

TEST(GmshWriter, WritesVersion4AsSpecified) {
    Mesh mesh = test::one_cell(test::cube_corner);
    mesh.regions = {7};
    mesh.facets = {{VertexIndex{0}, VertexIndex{1}, VertexIndex{2}},
                   {VertexIndex{0}, VertexIndex{1}, VertexIndex{3}}};
    mesh.facet_markers = {5, 0};
    const TemporaryFolder folder;
    EXPECT_EQ(write_mesh(mesh, folder / "a.msh", {.msh = {.is_text = true}}), "");
    EXPECT_EQ(content_of(folder / "a.msh"),
              "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
              "$PhysicalNames\n1\n2 1 \"octetra:untagged\"\n$EndPhysicalNames\n"
              "$Entities\n0 0 2 1\n1 0 0 0 1 1 1 1 1 0\n2 0 0 0 1 1 1 1 5 0\n1 0 0 0 1 1 1 1 7 0\n"
              "$EndEntities\n"
              "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"
              "$Elements\n3 3 1 3\n2 2 2 1\n1 1 2 3\n2 1 2 1\n2 1 2 4\n3 1 4 1\n3 1 2 3 4\n"
              "$EndElements\n");
    EXPECT_EQ(write_mesh(mesh, folder / "a.msh", {.msh = {.is_2 = true, .is_text = true}}), "");
    EXPECT_EQ(content_of(folder / "a.msh"),
              "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
              "$PhysicalNames\n1\n2 1 \"octetra:untagged\"\n$EndPhysicalNames\n"
              "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
              "$Elements\n3\n1 2 2 5 2 1 2 3\n2 2 2 1 1 1 2 4\n3 4 2 7 1 1 2 3 4\n$EndElements\n");
    mesh.facets.clear();
    mesh.facet_markers.clear();
    EXPECT_EQ(write_mesh(mesh, folder / "a.msh"), "");
    EXPECT_EQ(content_of(folder / "a.msh"), test::gmsh_binary_4());
    EXPECT_EQ(write_mesh(mesh, folder / "a.msh", {.msh = {.is_2 = true}}), "");
    EXPECT_EQ(content_of(folder / "a.msh"), test::gmsh_binary_2());
}

/// If there are groups, Gmsh saves and refines only what is in one.
TEST(GmshWriter, AssignsUntaggedElementsToAReservedGroupIfOthersAreTagged) {
    Mesh mesh = test::kuhn(2, 2, 2);
    test::list_boundary(mesh);
    mesh.index_base = 1;
    mesh.facet_markers.assign(mesh.facets.size(), 1);
    mesh.group_names = {{3, 1, "empty"}, {3, -2, "reversed"}};
    const auto names_and_read = [&](const Mesh& written, const MshFormat& format) {
        const TemporaryFolder folder;
        (void)write_mesh(written, folder / "a.msh", {.msh = format});
        EXPECT_EQ(read_mesh(folder / "a.msh"), written) << kind_of(format);
        test::expect_correct_shares(folder / "a.msh");
        return content_of(folder / "a.msh");
    };
    Mesh mixed = mesh;
    mixed.regions.assign(mesh.cells.size(), 0);
    mixed.regions[CellIndex{3}] = -3;
    Mesh cells_tagged = mixed;
    cells_tagged.facet_markers.clear();
    for (const MshFormat& format : all_formats) {
        EXPECT_THAT(names_and_read(mesh, format), HasSubstr("\n3 3 \"octetra:untagged\"\n"));
        EXPECT_THAT(names_and_read(mixed, format), HasSubstr("\n3 4 \"octetra:untagged\"\n"));
        EXPECT_THAT(names_and_read(cells_tagged, format),
                    AllOf(HasSubstr("\n2 1 \"octetra:untagged\"\n3 4 \"octetra:untagged\"\n")));
        Mesh nothing_tagged = mesh;
        nothing_tagged.facet_markers.clear();
        EXPECT_THAT(names_and_read(nothing_tagged, format), Not(HasSubstr("octetra:untagged")));
    }
}

TEST(GmshWriter, WritesTheNamesOfGroups) {
    Mesh mesh = test::one_cell(test::cube_corner);
    mesh.group_names = {{3, 7, "rock # 1"}};
    const TemporaryFolder folder;
    for (const MshFormat& format : all_formats) {
        EXPECT_EQ(write_mesh(mesh, folder / "a.msh", {.msh = format}), "");
        EXPECT_THAT(content_of(folder / "a.msh"),
                    HasSubstr("$EndMeshFormat\n$PhysicalNames\n1\n3 7 \"rock # 1\"\n"
                              "$EndPhysicalNames\n$"));
    }
    for (const std::string name : {"a.ele", "a.mesh", "a.vtu"}) {
        EXPECT_EQ(write_mesh(mesh, folder / name),
                  "the names of groups are lost; .msh and .octetra files hold them");
    }
}

TEST(GmshWriter, ReportsDataThatItCannotStore) {
    const TemporaryFolder folder;
    Mesh mesh = rich_mesh();
    EXPECT_THAT(write_mesh(mesh, folder / "a.msh"), HasSubstr("reads a negative marker"));
    mesh.regions.clear();
    EXPECT_EQ(write_mesh(mesh, folder / "a.msh"), "");
    mesh.point_markers.resize(mesh.points.size());
    EXPECT_THAT(write_mesh(mesh, folder / "a.msh"), HasSubstr("markers of vertices"));
    mesh.attributes_per_point = 2;
    mesh.point_attributes.resize(2 * mesh.points.size());
    EXPECT_THAT(write_mesh(mesh, folder / "a.msh"), HasSubstr("2 attribute(s) of each vertex"));
}

}  // namespace
}  // namespace octetra
