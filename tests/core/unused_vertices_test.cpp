#include <gtest/gtest.h>

#include <octetra/core/unused_vertices.hpp>

#include "support/meshes.hpp"

/// drop_unused_vertices().
namespace octetra {
namespace {

/// A mesh with a marker, two attributes, corners and a ridge, all different for each vertex.
Mesh full_mesh() {
    Mesh mesh = test::kuhn(1, 1, 1);
    test::list_boundary(mesh);
    mesh.attributes_per_point = 2;
    for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
        mesh.point_markers.push_back(static_cast<Marker>(100 + v));
        mesh.point_attributes.insert(mesh.point_attributes.end(), {0.5 * v, -1.0 * v});
    }
    mesh.edges.push_back({mesh.cells[CellIndex{0}][0], mesh.cells[CellIndex{0}][3]});
    mesh.edge_markers.push_back(7);
    mesh.features[Feature::corners] = {0, 2, 7};
    mesh.features[Feature::required_vertices] = {1, 2};
    mesh.features[Feature::ridges] = {0};
    return mesh;
}

/// The mesh with a vertex of no cell, a corner, before vertex `before`.
Mesh with_unused(Mesh mesh, std::uint32_t before) {
    mesh.points.insert(mesh.points.begin() + before, Point{0.5, 0.25, 0.125});
    mesh.point_markers.insert(mesh.point_markers.begin() + before, 99);
    mesh.point_attributes.insert(mesh.point_attributes.begin() + 2 * before, {8, 9});
    const auto renumber = [&](auto& list) {
        for (auto& entity : list) {
            for (VertexIndex& v : entity)
                v = VertexIndex{v.value() + (v.value() >= before ? 1 : 0)};
        }
    };
    renumber(mesh.cells);
    renumber(mesh.facets);
    renumber(mesh.edges);
    for (const Feature feature : {Feature::corners, Feature::required_vertices}) {
        for (std::uint64_t& v : mesh.features[feature]) v += v >= before ? 1 : 0;
        mesh.features[feature].push_back(before);
        sort_unique(mesh.features[feature]);
    }
    return mesh;
}

TEST(UnusedVertices, AreDroppedWithTheirData) {
    const Mesh mesh = full_mesh();
    for (const std::uint32_t before : {0U, 1U, 3U, 8U}) {
        Mesh padded = with_unused(mesh, before);
        EXPECT_EQ(drop_unused_vertices(padded), 1U) << before;
        EXPECT_EQ(padded, mesh) << before;
        padded = with_unused(with_unused(with_unused(mesh, before), before), 0);
        EXPECT_EQ(drop_unused_vertices(padded), 3U) << before;
        EXPECT_EQ(padded, mesh) << before;
    }
}

TEST(UnusedVertices, OfAMeshThatHasNoneStay) {
    Mesh mesh = full_mesh();
    EXPECT_EQ(drop_unused_vertices(mesh), 0U);
    EXPECT_EQ(mesh, full_mesh());
}

TEST(UnusedVertices, AreAllVerticesOfAMeshWithoutCells) {
    Mesh mesh;
    mesh.points.resize(3);
    EXPECT_EQ(drop_unused_vertices(mesh), 3U);
    EXPECT_EQ(mesh, Mesh());
}

}  // namespace
}  // namespace octetra
