#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <octetra/core/files/maps_files.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/maps.hpp>

#include "support/bits.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

namespace octetra {
namespace {

using test::TemporaryFolder;

/// A mesh with everything that files can contain.
Mesh rich_mesh() {
    Mesh mesh = test::perturbed_kuhn(2, 0.2, 3);
    test::list_boundary(mesh);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        mesh.regions.append(static_cast<Marker>(c.value() % 3) - 1);
    }
    for (const auto& [i, j] : cell_edges) {
        mesh.edges.append({mesh.cells[CellIndex{0}][i], mesh.cells[CellIndex{0}][j]});
        mesh.edge_markers.append(static_cast<Marker>(10 * i + j));
    }
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        mesh.point_markers.append(static_cast<Marker>(v.value() % 2) * 7);
    }
    return mesh;
}

/// A mesh whose coordinates are random doubles near those of a lattice.
Mesh awkward_numbers() {
    Mesh mesh = test::kuhn(3, 3, 3);
    std::mt19937_64 random(7);
    for (Point& p : mesh.points) {
        for (double* c : {&p.x, &p.y, &p.z}) {
            *c = *c / 3 + static_cast<double>(random()) * 0x1p-69;
        }
    }
    return mesh;
}

Mesh through_file(const Mesh& mesh, const std::string& name) {
    const TemporaryFolder folder;
    (void)write_mesh(mesh, folder / name);
    return read_mesh(folder / name);
}

TEST(RoundTrip, TetgenKeepsEverything) {
    Mesh mesh = rich_mesh();
    mesh.attributes_per_point = 2;
    for (std::size_t i = 0; i < 2 * mesh.points.size(); ++i) {
        mesh.point_attributes.push_back(std::sqrt(static_cast<double>(i)));
    }
    for (const std::uint32_t index_base : {0U, 1U}) {
        mesh.index_base = index_base;
        EXPECT_EQ(through_file(mesh, "rich.1.ele"), mesh);
        EXPECT_EQ(through_file(mesh, "rich.node"), mesh);
    }
}

TEST(RoundTrip, MeditKeepsEverythingButAttributes) {
    Mesh mesh = rich_mesh();
    mesh.index_base = 1;
    EXPECT_EQ(through_file(mesh, "rich.mesh"), mesh);
    EXPECT_EQ(through_file(mesh, "rich.meshb"), mesh);

    mesh.attributes_per_point = 1;
    mesh.point_attributes.assign(mesh.points.size(), 0.5);
    const TemporaryFolder folder;
    const std::string loss = write_mesh(mesh, folder / "a.mesh");
    EXPECT_NE(loss, "") << "the loss must be reported";
    EXPECT_EQ(write_mesh(mesh, folder / "a.meshb"), loss);
}

TEST(RoundTrip, CoordinatesKeepEveryBit) {
    Mesh mesh = awkward_numbers();
    EXPECT_EQ(test::bits(through_file(mesh, "a.ele")), test::bits(mesh));
    EXPECT_EQ(test::bits(through_file(mesh, "a.mesh")), test::bits(mesh));
    EXPECT_EQ(test::bits(through_file(mesh, "a.meshb")), test::bits(mesh));
}

TEST(RoundTrip, CoordinatesTakeNoMoreDigitsThanTheyNeed) {
    const TemporaryFolder folder;
    (void)write_mesh(test::one_cell({{{0.1, 0, 0}, {1.1, 0, 0}, {0.3, 1e300, 0}, {0, 0, 2.5e-9}}}),
                     folder / "a.ele");
    EXPECT_EQ(test::content_of(folder / "a.node"),
              "4 3 0 0\n0 0.1 0 0\n1 1.1 0 0\n2 0.3 1e+300 0\n3 0 0 2.5e-09\n");
}

TEST(RoundTrip, ExtremeCoordinatesKeepEveryBit) {
    const Mesh mesh = test::extreme_cell();
    EXPECT_EQ(test::bits(through_file(mesh, "a.ele")), test::bits(mesh));
    EXPECT_EQ(test::bits(through_file(mesh, "a.mesh")), test::bits(mesh));
    EXPECT_EQ(test::bits(through_file(mesh, "a.meshb")), test::bits(mesh));
}

TEST(RoundTrip, FilesOfTheSameMeshAreTheSameBytes) {
    const TemporaryFolder folder;
    const Mesh mesh = rich_mesh();
    for (const std::string extension : {"ele", "mesh", "meshb"}) {
        (void)write_mesh(mesh, folder / ("a." + extension));
        (void)write_mesh(read_mesh(folder / ("a." + extension)), folder / ("b." + extension));
        EXPECT_EQ(test::content_of(folder / ("a." + extension)),
                  test::content_of(folder / ("b." + extension)));
    }
    for (const std::string extension : {"node", "face", "edge"}) {
        EXPECT_EQ(test::content_of(folder / ("a." + extension)),
                  test::content_of(folder / ("b." + extension)));
    }
}

TEST(RoundTrip, LongFilesKeepTheirLinesAcrossBuffers) {
    const Mesh mesh = test::kuhn(40, 40, 40, 1.0 / 3);  // 384,000 cells, 9 MB of .ele
    EXPECT_TRUE(through_file(mesh, "a.ele") == mesh);
    Mesh from_medit = through_file(mesh, "a.mesh");
    EXPECT_TRUE(through_file(mesh, "a.meshb") == from_medit);
    from_medit.index_base = 0;
    EXPECT_TRUE(from_medit == mesh);
}

TEST(WriteMaps, NumbersEverythingAsTheMeshFilesDo) {
    const TemporaryFolder folder;
    Mesh mesh;
    mesh.points.resize(7);
    mesh.cells.resize(3);
    RefinementMaps maps;
    maps.cell_to_parent = {CellIndex{0}, CellIndex{0}, CellIndex{1}};
    maps.first_midpoint = VertexIndex{5};
    maps.midpoint_to_edge = {{VertexIndex{0}, VertexIndex{3}}, {VertexIndex{1}, VertexIndex{5}}};
    const auto written = [&](std::uint32_t index_base) {
        mesh.index_base = index_base;
        WholeMesh source(mesh, &maps);
        write_maps(source, folder / "maps");
        return test::content_of(folder / "maps");
    };
    EXPECT_EQ(written(0), "cells 3\n0 0\n1 0\n2 1\nmidpoints 2\n5 0 3\n6 1 5\n");
    EXPECT_EQ(written(1), "cells 3\n1 1\n2 1\n3 2\nmidpoints 2\n6 1 4\n7 2 6\n");
}

TEST(RoundTrip, EmptyMeshesAreMeshes) {
    EXPECT_EQ(through_file(Mesh{}, "a.ele"), Mesh{});
    EXPECT_EQ(through_file(Mesh{}, "a.mesh"), Mesh{});
    EXPECT_EQ(through_file(Mesh{}, "a.meshb"), Mesh{});
}

TEST(RoundTrip, TetgenLeavesNoFacesOfAnotherMeshBehind) {
    const TemporaryFolder folder;
    Mesh mesh = rich_mesh();
    (void)write_mesh(mesh, folder / "a.ele");
    mesh.facets.clear();
    mesh.facet_markers.clear();
    mesh.edges.clear();
    mesh.edge_markers.clear();
    (void)write_mesh(mesh, folder / "a.ele");
    EXPECT_EQ(read_mesh(folder / "a.ele"), mesh);
}

}  // namespace
}  // namespace octetra
