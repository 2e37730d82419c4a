#include <octetra/quality/mesh_statistics.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <tuple>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/quality/shape.hpp>

#include "compensated_sum.hpp"
#include "support/hostile_arithmetic.hpp"
#include "support/meshes.hpp"

namespace octetra::quality {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr double tolerance = 1e-12;

const Corners regular{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
const Corners kuhn{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}};
const Corners cube_corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
const Corners sommerville{{{0, 0, 0}, {2, 0, 0}, {1, 1, 1}, {1, 1, -1}}};

CellVertices cell(std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    return {VertexIndex{a}, VertexIndex{b}, VertexIndex{c}, VertexIndex{d}};
}

FacetVertices facet(std::size_t a, std::size_t b, std::size_t c) {
    return {VertexIndex{a}, VertexIndex{b}, VertexIndex{c}};
}

Mesh mesh_of(const Corners& corners) {
    Mesh mesh;
    mesh.points.assign(corners.begin(), corners.end());
    mesh.cells = {cell(0, 1, 2, 3)};
    return mesh;
}

/// Cells over vertices 0 .. vertex_count-1, for counts only: the vertices lie on a curve that meets
/// no plane in four points.
Mesh mesh_of(std::size_t vertex_count, std::initializer_list<CellVertices> cells) {
    Mesh mesh;
    for (std::size_t i = 0; i < vertex_count; ++i) {
        const auto t = static_cast<double>(i);
        mesh.points.push_back({t, t * t, t * t * t});
    }
    mesh.cells = cells;
    return mesh;
}

/// The six cells of each of n^3 cubes, along the diagonal from the low to the high corner.
Mesh kuhn_cube(std::size_t n) {
    Mesh mesh;
    const auto vertex = [n](const std::array<std::size_t, 3>& at) {
        return VertexIndex{(at[0] * (n + 1) + at[1]) * (n + 1) + at[2]};
    };
    const auto scale = [n](std::size_t i) {
        return static_cast<double>(i) / static_cast<double>(n);
    };
    for (std::size_t i = 0; i <= n; ++i)
        for (std::size_t j = 0; j <= n; ++j)
            for (std::size_t k = 0; k <= n; ++k)
                mesh.points.push_back({scale(i), scale(j), scale(k)});

    for (std::size_t cube = 0; cube < n * n * n; ++cube) {
        std::array<std::size_t, 3> axes{0, 1, 2};
        do {
            std::array<std::size_t, 3> at{cube / (n * n), cube / n % n, cube % n};
            CellVertices corners{vertex(at)};
            for (std::size_t step = 0; step < 3; ++step) {
                ++at[axes[step]];
                corners[step + 1] = vertex(at);
            }
            const bool even = (axes[1] + 3 - axes[0]) % 3 == 1;
            if (!even) std::swap(corners[1], corners[2]);
            mesh.cells.push_back(corners);
        } while (std::ranges::next_permutation(axes).found);
    }
    return mesh;
}

void expect_angles(const Corners& corners, double smallest, double largest) {
    const auto angles = dihedral_angles(corners);
    EXPECT_NEAR(std::ranges::min(angles), smallest, tolerance * 180);
    EXPECT_NEAR(std::ranges::max(angles), largest, tolerance * 180);
}

double degrees(double radians) { return radians * 180 / std::acos(-1.0); }

TEST(Shape, DihedralAnglesOfTheRegularTetrahedronHaveCosineOneThird) {
    expect_angles(regular, degrees(std::acos(1.0 / 3)), degrees(std::acos(1.0 / 3)));
}

TEST(Shape, DihedralAnglesOfTheKuhnTetrahedronAre45To90) { expect_angles(kuhn, 45, 90); }

TEST(Shape, DihedralAnglesOfTheCubeCornerHaveLeastCosineRootOneThird) {
    expect_angles(cube_corner, degrees(std::acos(std::sqrt(1.0 / 3))), 90);
}

TEST(Shape, DihedralAnglesOfTheSommervilleTetrahedronAre60To90) {
    expect_angles(sommerville, 60, 90);
}

TEST(Shape, DihedralAnglesAreInTheOrderOfTheEdges) {
    // The edges 01, 02, 03 of the cube corner lie on the axes.
    const auto angles = dihedral_angles(cube_corner);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(angles[k], 90, tolerance * 180);
    const double steep = degrees(std::acos(std::sqrt(1.0 / 3)));
    for (std::size_t k = 3; k < 6; ++k) EXPECT_NEAR(angles[k], steep, tolerance * 180);
}

TEST(Shape, DihedralAnglesDoNotDependOnTheOrderOfTheCorners) {
    const Corners corners{{{0, 0, 0}, {7, 0, 0}, {2, 5, 0}, {1, 2, 6}}};
    auto expected = dihedral_angles(corners);
    std::ranges::sort(expected);
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    do {
        auto angles = dihedral_angles(
            {corners[order[0]], corners[order[1]], corners[order[2]], corners[order[3]]});
        std::ranges::sort(angles);
        for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(angles[k], expected[k], tolerance * 180);
    } while (std::ranges::next_permutation(order).found);
}

TEST(Shape, AnglesOfANearlyFlatCellAreNear0And180) {
    const Corners flat{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0x1p-40}, {0, 1, 0}}};
    const auto angles = dihedral_angles(flat);
    EXPECT_NEAR(std::ranges::max(angles), 180, 1e-9);
    EXPECT_LT(std::ranges::min(angles), 1e-9);
    EXPECT_GT(std::ranges::min(angles), 1e-12);
}

TEST(Shape, MeanRatiosAreThoseOfTheKnownShapes) {
    EXPECT_NEAR(mean_ratio(regular), 1, tolerance);
    EXPECT_NEAR(mean_ratio(kuhn), std::cbrt(54.0 / 125), tolerance);
    EXPECT_NEAR(mean_ratio(cube_corner), std::cbrt(16.0 / 27), tolerance);
    EXPECT_NEAR(mean_ratio(sommerville), std::cbrt(108.0 / 125), tolerance);
}

TEST(Shape, MeanRatioIs0ForAFlatCellAndForAPoint) {
    EXPECT_EQ(mean_ratio({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}), 0);
    EXPECT_EQ(mean_ratio({{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}}), 0);
}

TEST(Shape, ScalingByAnyPowerOfTwoChangesNoAngleAndNoMeanRatio) {
    for (const double factor : {0x1p-330, 0x1p-10, 0x1p300}) {
        Corners corners = kuhn;
        for (Point& p : corners) p = {p.x * factor, p.y * factor, p.z * factor};
        EXPECT_EQ(dihedral_angles(corners), dihedral_angles(kuhn)) << factor;
        EXPECT_EQ(mean_ratio(corners), mean_ratio(kuhn)) << factor;
    }
}

TEST(Shape, TriangleAnglesAndAreaAreThoseOfARightTriangle) {
    const Triangle triangle{{{0, 0, 0}, {3, 0, 0}, {0, 0, 4}}};
    EXPECT_DOUBLE_EQ(area(triangle), 6);
    const auto angles = corner_angles(triangle);
    EXPECT_NEAR(angles[0], 90, tolerance * 180);
    EXPECT_NEAR(angles[1], degrees(std::atan(4.0 / 3)), tolerance * 180);
    EXPECT_NEAR(angles[2], degrees(std::atan(3.0 / 4)), tolerance * 180);
}

TEST(CompensatedSum, KeepsDigitsThatALargeTermWouldAbsorb) {
    CompensatedSum sum;
    for (const double term : {1.0, 1e100, 1.0, -1e100}) sum.add(term);
    EXPECT_EQ(sum.value(), 2);
}

TEST(Shape, IsTheSameAtEveryScale) {
    const Corners cell{{{0, 0, 0}, {7, 0, 0}, {2, 5, 0}, {1, 2, 6}}};
    for (const int exponent : {-1074, -1022, -540, -300, 300, 510, 600, 1019}) {
        Corners far = cell;
        for (Point& p : far) {
            p = {std::scalbn(p.x, exponent), std::scalbn(p.y, exponent),
                 std::scalbn(p.z, exponent)};
        }
        EXPECT_EQ(mean_ratio(far), mean_ratio(cell)) << exponent;
        EXPECT_EQ(dihedral_angles(far), dihedral_angles(cell)) << exponent;
        EXPECT_EQ(corner_angles({far[0], far[1], far[2]}),
                  corner_angles({cell[0], cell[1], cell[2]}))
            << exponent;
    }
}

TEST(Shape, IsFiniteForTheLargestCells) {
    const double most = std::nextafter(coordinate_limit, 0.0);
    const Corners cell{
        {{-most, -most, -most}, {most, -most, -most}, {-most, most, -most}, {-most, -most, most}}};
    EXPECT_NEAR(mean_ratio(cell), std::cbrt(16.0 / 27), 1e-15);
    EXPECT_NEAR(dihedral_angles(cell)[0], 90, 1e-13);
    EXPECT_NEAR(corner_angles({cell[1], cell[2], cell[3]})[0], 60, 1e-13);
}

TEST(CompensatedSum, OfAMillionTenthsIsCorrectlyRounded) {
    CompensatedSum sum;
    for (int i = 0; i < 1'000'000; ++i) sum.add(0.1);
    EXPECT_EQ(sum.value(), 100'000);
}

TEST(Histogram, ABoundBelongsToTheBinThatItBegins) {
    Histogram histogram(0, 180, 18);
    for (const double value : {0.0, 9.999, 10.0, 60.0 - 1e-13, 60.0, 180.0}) histogram.add(value);
    EXPECT_THAT(histogram.counts,
                ElementsAre(2, 1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1));
}

TEST(Histogram, ValuesOutsideAndNansAreCountedAtAnEnd) {
    Histogram histogram(0, 1, 2);
    for (const double value : {-3.0, std::nan(""), 7.0, HUGE_VAL}) histogram.add(value);
    EXPECT_THAT(histogram.counts, ElementsAre(2, 2));
}

TEST(Measure, AnEmptyMeshHasNothing) {
    const MeshStatistics s = measure(Mesh{});
    EXPECT_EQ(s.counts, EntityCounts{});
    EXPECT_FALSE(s.bounding_box || s.edge_length || s.cell_volume || s.face_angle);
    EXPECT_FALSE(s.dihedral_angle || s.eta || s.adjacency);
    EXPECT_EQ(s.volume, 0);
    EXPECT_EQ(s.boundary_area, 0);
    EXPECT_THAT(s.regions, IsEmpty());
    EXPECT_THAT(s.facet_markers, IsEmpty());
    EXPECT_THAT(s.dihedral_histogram.counts, Each(0));
    EXPECT_THAT(s.eta_histogram.counts, Each(0));
}

TEST(Measure, VerticesWithoutCellsAreUnusedAndHaveNoOtherEffect) {
    Mesh mesh = mesh_of(kuhn);
    mesh.points.push_back({100, 100, 100});
    mesh.points.push_back({-100, 0, 0});
    const MeshStatistics s = measure(mesh);
    EXPECT_EQ(s.counts.vertices, 6);
    EXPECT_EQ(s.counts.unused_vertices, 2);
    EXPECT_EQ(s.counts.components, 1);
    EXPECT_EQ(s.counts.euler_characteristic, 1);
    EXPECT_EQ(s.bounding_box->low, (Point{0, 0, 0}));
    EXPECT_EQ(s.bounding_box->high, (Point{1, 1, 1}));
    EXPECT_EQ(s.adjacency->edges_per_vertex, 3);
}

TEST(Measure, OneCellIsABall) {
    const MeshStatistics s = measure(mesh_of(kuhn));
    const EntityCounts expected{.vertices = 4,
                                .edges = 6,
                                .faces = 4,
                                .cells = 1,
                                .boundary_faces = 4,
                                .components = 1,
                                .euler_characteristic = 1};
    EXPECT_EQ(s.counts, expected);
    EXPECT_EQ(*s.adjacency, (Adjacency{1, 1, 3, 2, 1, 1}));
    EXPECT_DOUBLE_EQ(s.volume, 1.0 / 6);
    EXPECT_DOUBLE_EQ(s.boundary_area, 1 + std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(s.edge_length->min, 1);
    EXPECT_DOUBLE_EQ(s.edge_length->max, std::sqrt(3.0));
}

/// Expected statistics of two cells that share a part of their boundary.
struct Pair {
    const char* name;
    Mesh mesh;
    EntityCounts counts;
    std::size_t max_cells_at_edge;
    std::size_t max_cells_at_vertex;
};

void expect(const Pair& pair) {
    const MeshStatistics s = measure(pair.mesh);
    EXPECT_EQ(s.counts, pair.counts) << pair.name;
    EXPECT_EQ(s.adjacency->max_cells_at_edge, pair.max_cells_at_edge) << pair.name;
    EXPECT_EQ(s.adjacency->max_cells_at_vertex, pair.max_cells_at_vertex) << pair.name;
}

TEST(Measure, TwoCellsShareAFaceAnEdgeAVertexOrNothing) {
    const CellVertices first = cell(0, 1, 2, 3);
    expect(
        {"face", mesh_of(5, {first, cell(4, 3, 2, 1)}), {5, 9, 7, 2, 6, 0, 0, 0, 0, 1, 1}, 2, 2});
    expect(
        {"edge", mesh_of(6, {first, cell(5, 4, 3, 2)}), {6, 11, 8, 2, 8, 0, 0, 0, 0, 1, 1}, 2, 2});
    expect({"vertex",
            mesh_of(7, {first, cell(3, 6, 5, 4)}),
            {7, 12, 8, 2, 8, 0, 0, 0, 0, 1, 1},
            1,
            2});
    expect({"nothing",
            mesh_of(8, {first, cell(7, 6, 5, 4)}),
            {8, 12, 8, 2, 8, 0, 0, 0, 0, 2, 2},
            1,
            1});
}

TEST(Measure, AFaceOfThreeCellsIsNonManifoldAndNotOfTheBoundary) {
    const MeshStatistics s =
        measure(mesh_of(6, {cell(0, 1, 2, 3), cell(0, 1, 2, 4), cell(0, 1, 2, 5)}));
    EXPECT_EQ(s.counts.nonmanifold_faces, 1);
    EXPECT_EQ(s.counts.boundary_faces, 9);
    EXPECT_EQ(s.counts.faces, 10);
    EXPECT_EQ(s.adjacency->max_cells_at_edge, 3);
}

class KuhnCube : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Sizes, KuhnCube, testing::Values(1, 2, 3, 5, 8));

TEST_P(KuhnCube, HasTheCountsOfTheClosedForms) {
    const std::size_t n = GetParam();
    const EntityCounts expected{.vertices = (n + 1) * (n + 1) * (n + 1),
                                .edges = 7 * n * n * n + 9 * n * n + 3 * n,
                                .faces = 12 * n * n * n + 6 * n * n,
                                .cells = 6 * n * n * n,
                                .boundary_faces = 12 * n * n,
                                .components = 1,
                                .euler_characteristic = 1};
    EXPECT_EQ(measure(kuhn_cube(n)).counts, expected);
}

TEST_P(KuhnCube, HasTheAdjacencyOfTheClosedForms) {
    const auto n = static_cast<double>(GetParam());
    const double n2 = n * n;
    const double n3 = n2 * n;
    const double edges = 7 * n3 + 9 * n2 + 3 * n;
    const double vertices = (n + 1) * (n + 1) * (n + 1);
    const Adjacency adjacency = *measure(kuhn_cube(GetParam())).adjacency;
    EXPECT_DOUBLE_EQ(adjacency.cells_per_edge, 36 * n3 / edges);
    EXPECT_DOUBLE_EQ(adjacency.cells_per_vertex, 24 * n3 / vertices);
    EXPECT_DOUBLE_EQ(adjacency.edges_per_vertex, 2 * edges / vertices);
    EXPECT_DOUBLE_EQ(adjacency.faces_per_edge, 3 * (12 * n3 + 6 * n2) / edges);
    EXPECT_EQ(adjacency.max_cells_at_edge, 6);
    EXPECT_EQ(adjacency.max_cells_at_vertex, n == 1 ? 6 : 24);
}

TEST_P(KuhnCube, IsTheUnitCubeMadeOfKuhnTetrahedra) {
    const std::size_t n = GetParam();
    const auto width = 1 / static_cast<double>(n);
    const MeshStatistics s = measure(kuhn_cube(n));
    const auto near = [](double value, double expected) {
        EXPECT_NEAR(value, expected, tolerance * std::max(1.0, expected));
    };
    near(s.volume, 1);
    near(s.boundary_area, 6);
    near(s.edge_length->min, width);
    near(s.edge_length->max, width * std::sqrt(3.0));
    near(s.cell_volume->min, width * width * width / 6);
    near(s.cell_volume->max, width * width * width / 6);
    near(s.face_angle->min, degrees(std::atan(std::sqrt(0.5))));
    near(s.face_angle->max, 90);
    near(s.dihedral_angle->min, 45);
    near(s.dihedral_angle->max, 90);
    near(s.eta->min, std::cbrt(54.0 / 125));
    near(s.eta->mean, std::cbrt(54.0 / 125));
    near(s.eta->max, std::cbrt(54.0 / 125));
    EXPECT_EQ(s.bounding_box->low, (Point{0, 0, 0}));
    EXPECT_EQ(s.bounding_box->high, (Point{1, 1, 1}));
}

TEST_P(KuhnCube, HasItsAnglesInThreeBinsHoweverTheyAreRounded) {
    const MeshStatistics s = measure(kuhn_cube(GetParam()));
    const std::size_t cells = s.counts.cells;
    std::vector<std::size_t> angles(18, 0);
    angles[4] = 2 * cells;  // 45 degrees
    angles[6] = cells;      // 60
    angles[9] = 3 * cells;  // 90
    EXPECT_EQ(s.dihedral_histogram.counts, angles);
    std::vector<std::size_t> etas(10, 0);
    etas[7] = cells;
    EXPECT_EQ(s.eta_histogram.counts, etas);
}

TEST(Measure, DoesNotDependOnTheOrderOfCellsAndCorners) {
    const Mesh mesh = kuhn_cube(4);
    Mesh other = mesh;
    std::ranges::reverse(other.cells);
    for (CellVertices& c : other.cells) std::rotate(c.begin(), c.begin() + 1, c.end());
    const MeshStatistics a = measure(mesh);
    const MeshStatistics b = measure(other);
    EXPECT_EQ(a.counts, b.counts);
    EXPECT_EQ(a.volume, b.volume);
    EXPECT_EQ(a.boundary_area, b.boundary_area);
    EXPECT_EQ(a.edge_length, b.edge_length);
    EXPECT_EQ(a.adjacency, b.adjacency);
    EXPECT_EQ(a.dihedral_histogram, b.dihedral_histogram);
}

void expect_total(const TagTotal& total, Marker tag, std::size_t count, double size) {
    EXPECT_EQ(total.tag, tag);
    EXPECT_EQ(total.count, count);
    EXPECT_DOUBLE_EQ(total.size, size);
}

TEST(Measure, RegionsHaveTheirCellsAndVolumesAscendingByTag) {
    Mesh mesh = kuhn_cube(2);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        mesh.regions.push_back(c.value() % 6 == 0 ? -7 : c.value() < 24 ? 5 : 3);
    }
    const MeshStatistics s = measure(mesh);
    ASSERT_EQ(s.regions.size(), 3);
    expect_total(s.regions[0], -7, 8, 8.0 / 48);
    expect_total(s.regions[1], 3, 20, 20.0 / 48);
    expect_total(s.regions[2], 5, 20, 20.0 / 48);
}

TEST(Measure, FacetMarkersHaveTheirTaggedFacetsAndAreas) {
    Mesh mesh = mesh_of(cube_corner);
    mesh.facets = {facet(0, 1, 2), facet(1, 2, 3), facet(0, 2, 3)};
    mesh.facet_markers = {2, 1, 2};
    const MeshStatistics s = measure(mesh);
    EXPECT_EQ(s.counts.tagged_facets, 3);
    ASSERT_EQ(s.facet_markers.size(), 2);
    expect_total(s.facet_markers[0], 1, 1, std::sqrt(3.0) / 2);
    expect_total(s.facet_markers[1], 2, 2, 1);
}

TEST(Measure, EdgeMarkersHaveTheirTaggedEdgesAndLengthsAndFeaturesAreCounted) {
    Mesh mesh = mesh_of(cube_corner);
    mesh.edges = {{VertexIndex{0}, VertexIndex{1}}, {VertexIndex{1}, VertexIndex{3}}};
    mesh.edge_markers = {4, -1};
    mesh.features[Feature::ridges] = {0, 1};
    mesh.features[Feature::required_vertices] = {3};
    const MeshStatistics s = measure(mesh);
    ASSERT_EQ(s.edge_markers.size(), 2);
    expect_total(s.edge_markers[0], -1, 1, std::sqrt(2.0));
    expect_total(s.edge_markers[1], 4, 1, 1);
    EXPECT_EQ(s.features[Feature::ridges], 2);
    EXPECT_EQ(s.features[Feature::required_vertices], 1);
    EXPECT_EQ(s.features[Feature::corners], 0);
}

TEST(Measure, WithoutTagsAndMarkersThereAreNoTotals) {
    Mesh mesh = mesh_of(cube_corner);
    mesh.facets = {facet(0, 1, 2)};
    mesh.edges = {{VertexIndex{0}, VertexIndex{1}}, {VertexIndex{1}, VertexIndex{3}}};
    const MeshStatistics s = measure(mesh);
    EXPECT_EQ(s.counts.tagged_facets, 1);
    EXPECT_EQ(s.counts.tagged_edges, 2);
    EXPECT_THAT(s.regions, IsEmpty());
    EXPECT_THAT(s.facet_markers, IsEmpty());
    EXPECT_THAT(s.edge_markers, IsEmpty());
}

TEST(Measure, IsTheSameInAnyFloatingPointEnvironment) {
    Mesh mesh = test::perturbed_kuhn(2, 0.2, 1);
    mesh.points[VertexIndex{0}].x = 1e-310;
    const auto work = [&] {
        const MeshStatistics s = measure(mesh);
        return std::tuple(s.counts, s.volume, s.edge_length, s.cell_volume, s.dihedral_angle,
                          s.face_angle, s.eta->mean, s.bounding_box->low.x);
    };
    EXPECT_TRUE(test::in_hostile_arithmetic(work) == work());
}

}  // namespace
}  // namespace octetra::quality
