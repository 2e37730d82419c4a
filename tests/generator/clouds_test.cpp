#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/error.hpp>
#include <octetra/generator/clouds.hpp>
#include <octetra/generator/tetgen.hpp>

#include "mesh_facts.hpp"

namespace octetra::generator::test {
namespace {

class Clouds : public testing::Test {
protected:
    void SetUp() override {
        if (!has_tetgen()) GTEST_SKIP() << "built without TetGen";
    }
};

void expect_hull_tagged(const Mesh& mesh) {
    EXPECT_EQ(tagged_facets(mesh), boundary_of(mesh));
    EXPECT_EQ(mesh.facets.size(), boundary_of(mesh).size());
    const std::map<Marker, std::size_t> expected{{1, mesh.facets.size()}};
    EXPECT_EQ(facets_by_marker(mesh), expected);
}

TEST_F(Clouds, RandomMeshIsABallOfOrientedCellsWithItsHullTagged) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Mesh mesh = random(200, seed);
        EXPECT_EQ(mesh.points.size(), 200U);
        EXPECT_EQ(mesh.index_base, 0U);
        EXPECT_TRUE(all_positively_oriented(mesh));
        EXPECT_EQ(euler_characteristic(mesh), 1);
        expect_hull_tagged(mesh);
        EXPECT_TRUE(mesh.regions.empty() && mesh.edges.empty() && mesh.point_markers.empty());
    }
}

TEST_F(Clouds, RandomMeshDependsOnItsSeedAlone) {
    EXPECT_EQ(random(50, 7), random(50, 7));
    EXPECT_NE(random(50, 7), random(50, 8));
}

TEST_F(Clouds, RandomPointsAreTheSameOnEveryPlatform) {
    // The standard specifies the 10000th draw of std::mt19937_64 from its default seed: here, the x
    // of point 3333.
    const Mesh mesh = random(3334, 5489);
    const double expected = static_cast<double>(9981545732273789042U >> 11U) * 0x1p-53;
    EXPECT_EQ(mesh.points[VertexIndex{3333}].x, expected);
}

TEST_F(Clouds, RandomMeshIsDelaunay) {
    const Mesh mesh = random(60, 4);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const auto [a, b, d, e] = corners_of(mesh, c);
        for (const Point& p : mesh.points) {
            // Delaunay condition: lifted onto the paraboloid, no point lies below the plane through
            // the cell's corners.
            const auto lifted = [&](const Point& q) { return squared_length({q, p}); };
            const double above =
                lifted(a) * six_volumes({b, d, e, p}) - lifted(b) * six_volumes({a, d, e, p}) +
                lifted(d) * six_volumes({a, b, e, p}) - lifted(e) * six_volumes({a, b, d, p});
            EXPECT_GT(above, -1e-14);
        }
    }
}

TEST_F(Clouds, SmallestRandomMeshIsOneCell) { EXPECT_EQ(random(4, 1).cells.size(), 1U); }

TEST_F(Clouds, SliversAboundAndNoneIsFlat) {
    const Mesh mesh = slivers(6, 1);
    EXPECT_EQ(mesh.points.size(), 216U);
    EXPECT_TRUE(all_positively_oriented(mesh));
    EXPECT_EQ(euler_characteristic(mesh), 1);
    expect_hull_tagged(mesh);
    // Six times the volume of a cell of the lattice is one or two cubes of the spacing.
    const double cube = 1.0 / (5 * 5 * 5);
    std::size_t nearly_flat = 0;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        nearly_flat += six_volumes(corners_of(mesh, c)) < 1e-4 * cube ? 1U : 0U;
    }
    EXPECT_GT(nearly_flat, mesh.cells.size() / 10);
}

TEST_F(Clouds, SliversLieWithinAMillionthOfTheirLattice) {
    const Mesh mesh = slivers(4, 9);
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        const std::uint32_t number = v.value();
        EXPECT_NEAR(mesh.points[v].x * 3, number % 4, 1.000001e-6);
        EXPECT_NEAR(mesh.points[v].y * 3, number / 4 % 4, 1.000001e-6);
        EXPECT_NEAR(mesh.points[v].z * 3, number / 16, 1.000001e-6);
    }
    EXPECT_EQ(slivers(4, 9), mesh);
    EXPECT_NE(slivers(4, 10), mesh);
}

TEST_F(Clouds, NothingIsPrinted) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    (void)random(20, 1);
    EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

TEST(CloudParameters, OutOfBoundsAreRefused) {
    EXPECT_THROW((void)random(0, 1), InputError);
    EXPECT_THROW((void)random(3, 1), InputError);
    EXPECT_THROW((void)random((std::uint64_t{1} << 26U) + 1, 1), InputError);
    EXPECT_THROW((void)slivers(0, 1), InputError);
    EXPECT_THROW((void)slivers(1, 1), InputError);
    EXPECT_THROW((void)slivers(401, 1), InputError);
}

TEST(Tetgen, IsAvailableOrItsShapesReportHowToInstallIt) {
    try {
        EXPECT_EQ(random(10, 1).points.size(), 10U);
        EXPECT_TRUE(has_tetgen());
    } catch (const InputError& error) {
        EXPECT_FALSE(has_tetgen());
        EXPECT_NE(std::string(error.what()).find("libtet1.5-dev"), std::string::npos);
    }
}

}  // namespace
}  // namespace octetra::generator::test
