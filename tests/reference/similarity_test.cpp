#include <array>
#include <cstdint>
#include <numeric>
#include <set>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/reference/refine.hpp>

#include "support/meshes.hpp"
#include "support/refinement.hpp"

/// The number of shapes that uniform 8T-LE makes: similarity classes by exact integers; mirror
/// images count as one.
namespace octetra::reference {
namespace {

using testing::ElementsAre;

constexpr int deepest = 6;

/// The squared edge lengths 01 02 03 12 13 23 divided by their common factor, for the order of the
/// corners for which they are lexicographically first.
using Shape = std::array<std::int64_t, 6>;

Shape shape_of(const Corners& corners) {
    std::array<std::array<std::int64_t, 4>, 4> squared{};
    std::int64_t common = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            const Point& p = corners[i];
            const Point& q = corners[j];
            const double length =
                (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z);
            squared[i][j] = static_cast<std::int64_t>(length);  // integers below 2^53: exact
            common = std::gcd(common, squared[i][j]);
        }
    }
    Shape least{};
    bool first = true;
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    do {
        Shape shape{};
        for (std::size_t e = 0; e < 6; ++e) {
            shape[e] = squared[order[cell_edges[e][0]]][order[cell_edges[e][1]]] / common;
        }
        if (first || shape < least) least = shape;
        first = false;
    } while (std::ranges::next_permutation(order).found);
    return least;
}

/// eta of a shape: (432 D^2 / S^3)^(1/3), D six times the volume, S the sum of squared edges.
double eta(const Corners& corners) {
    const auto determinant = static_cast<double>(test::exact_volume(corners, 1));
    double sum = 0;
    for (const auto& [i, j] : cell_edges) {
        const Point& p = corners[i];
        const Point& q = corners[j];
        sum += (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z);
    }
    return std::cbrt(432 * determinant * determinant / (sum * sum * sum));
}

struct Census {
    std::vector<std::size_t> new_classes;  ///< at each level, up to the last with any
    std::vector<double> least_eta;         ///< at each level
};

Census shapes_by_level(std::array<Point, 4> corners, int levels) {
    const double scale = std::ldexp(1, levels);  // keeps all midpoints at integers
    for (Point& p : corners) p = {p.x * scale, p.y * scale, p.z * scale};
    std::set<Shape> known;
    Census census;
    Mesh mesh = test::one_cell(corners);
    for (int level = 0; level <= levels; ++level) {
        if (level > 0) mesh = refine(mesh, {.all = true}, Scheme::eight, 1).mesh;
        const std::size_t before = known.size();
        double least = 1;
        for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
            const Corners cell = test::corners_of(mesh, c);
            known.insert(shape_of(cell));
            least = std::min(least, eta(cell));
        }
        census.new_classes.push_back(known.size() - before);
        census.least_eta.push_back(least);
    }
    while (census.new_classes.back() == 0) census.new_classes.pop_back();
    return census;
}

TEST(Similarity, OfTheKuhnCellIsOneClassForEver) {
    EXPECT_THAT(shapes_by_level(test::kuhn_corners, deepest).new_classes, ElementsAre(1));
}

TEST(Similarity, OfSommervillesCellIsTwoClasses) {
    const auto classes = shapes_by_level(test::sommerville_corners, deepest).new_classes;
    EXPECT_EQ(std::accumulate(classes.begin(), classes.end(), 0U), 2U);
}

TEST(Similarity, OfTheCubeCornerIsFourClasses) {
    const auto classes = shapes_by_level(test::cube_corner, deepest).new_classes;
    EXPECT_EQ(std::accumulate(classes.begin(), classes.end(), 0U), 4U);
}

TEST(Similarity, OfTheTieFreeExampleIsFortyClassesAndItsQualityStopsFalling) {
    const Census census = shapes_by_level(test::tie_free_corners, deepest);
    EXPECT_THAT(census.new_classes, ElementsAre(1, 6, 20, 13));
    EXPECT_NEAR(census.least_eta.front(), 0.9178, 5e-5);
    EXPECT_NEAR(census.least_eta[3], 0.4489, 5e-5);
    EXPECT_EQ(census.least_eta.back(), census.least_eta[3]);
}

TEST(Similarity, OfTheTypeOExampleIsThirteenClasses) {
    const Census census = shapes_by_level(test::type_o_corners, deepest);
    EXPECT_THAT(census.new_classes, ElementsAre(1, 8, 4));
    EXPECT_NEAR(census.least_eta.front(), 0.99995, 5e-6);
    EXPECT_NEAR(census.least_eta.back(), 0.66889, 5e-6);
}

}  // namespace
}  // namespace octetra::reference
