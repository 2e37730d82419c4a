#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/orientation.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "distributed/adaptive_steps.hpp"
#include "distributed/marked_mesh.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"

/// Orientation of faces and facets, and numberings, held against the whole mesh.
namespace octetra::distributed {
namespace {

/// Meshes after full sweeps and incremental steps, moved and coarsened.
std::vector<AdaptiveMesh> numbered_meshes() {
    std::vector<AdaptiveMesh> meshes;
    for (const PartitionMethod method : {PartitionMethod::block, PartitionMethod::random}) {
        AdaptiveMesh& mesh = meshes.emplace_back(
            shared_out(test::marked_lattice(3, 1), {.method = method, .seed = 3}));
        (void)mesh.refine(Selection{.random = RandomShare{0.3, 5}});
        (void)mesh.rebalance({.most_over_mean = 1});
        (void)mesh.refine(steps[0]);
        (void)mesh.coarsen(Selection{.random = RandomShare{0.8, 2}});
    }
    return meshes;
}

std::uint64_t global_number(const AdaptiveMesh& mesh, VertexIndex v) {
    return static_cast<std::uint64_t>(mesh.vertex_numbers()[v.value()]);
}

template <std::size_t N>
std::array<std::uint64_t, N> global_numbers(const AdaptiveMesh& mesh,
                                            const std::array<VertexIndex, N>& vertices) {
    std::array<std::uint64_t, N> numbers{};
    std::ranges::transform(vertices, numbers.begin(),
                           [&](VertexIndex v) { return global_number(mesh, v); });
    return numbers;
}

template <std::size_t N>
std::array<VertexIndex, N> in_order(std::array<VertexIndex, N> vertices) {
    std::ranges::sort(vertices);
    return vertices;
}

std::array<Point, 3> points_of(const AdaptiveMesh& mesh, const FacetVertices& face) {
    const auto points = mesh.points();
    return {points[face[0].value()], points[face[1].value()], points[face[2].value()]};
}

/// Does the normal of this face of a cell point to the side on which the cell is not?
bool leaves_behind(const AdaptiveMesh& mesh, const FacetVertices& face, VertexIndex opposite) {
    const auto& [a, b, c] = points_of(mesh, face);
    return orientation(a, b, c, mesh.points()[opposite.value()]) < 0;
}

/// The ascending vertices of the boundary faces of this process.
std::map<FacetVertices, BoundaryFace> boundary_of(const AdaptiveMesh& mesh) {
    std::map<FacetVertices, BoundaryFace> faces;
    for (const BoundaryFace& face : mesh.boundary()) {
        faces.emplace(in_order(outward_face(mesh.cells()[face.cell.value()], face.face)), face);
    }
    return faces;
}

TEST(Orientation, OfBoundaryFacesIsOutward) {
    for (const AdaptiveMesh& mesh : numbered_meshes()) {
        double flux = 0;  // of the vector field x through the boundary: three times the volume
        for (const auto& [number, face] : mesh.boundary()) {
            const CellVertices& cell = mesh.cells()[number.value()];
            const FacetVertices corners = outward_face(cell, face);
            EXPECT_TRUE(leaves_behind(mesh, corners, cell[face]));
            const auto& [a, b, c] = points_of(mesh, corners);
            flux += (a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
                     a.z * (b.x * c.y - b.y * c.x)) /
                    2;
        }
        double volumes = 0;
        for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
            volumes += volume(corners_of(mesh, c));
        }
        double difference = 0;
        for (const auto& of_one : test::of_all(std::vector<double>{flux - 3 * volumes})) {
            difference += of_one[0];
        }
        EXPECT_NEAR(difference, 0, 1e-9);
    }
}

TEST(Orientation, OfTaggedFacetsIsOutwardOnTheBoundaryAndAscendingInside) {
    for (const AdaptiveMesh& mesh : numbered_meshes()) {
        const auto boundary = boundary_of(mesh);
        const std::vector<FacetVertices> oriented = mesh.oriented_facets();
        ASSERT_EQ(oriented.size(), mesh.facets().size());
        std::array<std::uint64_t, 3> kinds{};
        for (std::size_t f = 0; f < oriented.size(); ++f) {
            const FacetVertices ascending = in_order(mesh.facets()[f]);
            EXPECT_EQ(in_order(oriented[f]), ascending);
            const auto found = boundary.find(ascending);
            if (found == boundary.end()) {
                EXPECT_EQ(oriented[f], ascending);
                ++kinds[0];
            } else {
                const auto& [c, face] = found->second;
                const VertexIndex opposite = mesh.cells()[c.value()][face];
                EXPECT_TRUE(leaves_behind(mesh, oriented[f], opposite));
                ++kinds[leaves_behind(mesh, mesh.facets()[f], opposite) ? 1 : 2];
            }
        }
        test::world().sum(kinds);
        EXPECT_GT(std::ranges::min(kinds), 0U);  // some stand the other way round in the input
    }
}

TEST(Orientation, OfEdgesAndFacesIsTheSameOnAllProcesses) {
    for (const AdaptiveMesh& mesh : numbered_meshes()) {
        for (const EdgeVertices& edge : mesh.number_edges().vertices) {
            EXPECT_LT(global_number(mesh, edge[0]), global_number(mesh, edge[1]));
        }
        const MeshFaces faces = mesh.number_faces();
        for (const FacetVertices& face : faces.vertices) {
            EXPECT_TRUE(std::ranges::is_sorted(global_numbers(mesh, face)));
        }
        for (CellIndex c{0}; c < faces.of_cell.end_index(); ++c) {
            const CellVertices& cell = mesh.cells()[c.value()];
            for (std::size_t f = 0; f < 4; ++f) {
                EXPECT_EQ(points_outward(cell, f),
                          leaves_behind(mesh, faces.vertices[faces.of_cell[c][f]], cell[f]));
            }
        }
    }
}

}  // namespace
}  // namespace octetra::distributed
