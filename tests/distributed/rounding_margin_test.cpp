#include "level/rounding_margin.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "level/rounding_failure.hpp"
#include "pattern/patterns.hpp"
#include "support/meshes.hpp"

/// A cell with a margin has valid children for every order of its edges, however flat it is.
namespace octetra::distributed {
namespace {

constexpr CellVertices cell{VertexIndex{0}, VertexIndex{1}, VertexIndex{2}, VertexIndex{3}};

/// The corners of the cell and the midpoints of its edges, by position in the table.
IndexVector<VertexIndex, Point> points_and_midpoints(const std::array<Point, 4>& corners) {
    IndexVector<VertexIndex, Point> points(corners.begin(), corners.end());
    for (const auto& [i, j] : cell_edges) points.push_back(midpoint(corners[i], corners[j]));
    return points;
}

/// Returns whether the children are valid if all edges are bisected, for every order.
bool has_sound_children(const IndexVector<VertexIndex, Point>& points) {
    for (LengthOrder order = 0; order < order_count; ++order) {
        const Pattern& pattern = PatternTable::get().pattern(order, 0b111111);
        for (const auto& places : pattern.children) {
            CellVertices child;
            for (std::size_t k = 0; k < 4; ++k) child[k] = VertexIndex{places[k]};
            if (sign_of(child, points) <= 0) return false;
        }
    }
    return true;
}

class ThinCells {
public:
    explicit ThinCells(std::uint64_t seed) : random_(seed) {}

    /// Positively oriented cells of all sizes and degrees of flatness, at various distances from
    /// the origin.
    std::array<Point, 4> next() {
        while (true) {
            const double size = std::exp2(-20 * uniform());
            const double thickness = size * std::exp2(-55 * uniform());
            const Point at{uniform() + 1, uniform() + 1, uniform()};
            std::array<Point, 4> corners;
            for (Point& p : corners) {
                p = {at.x + size * uniform(), at.y + size * uniform(), thickness * uniform()};
                // Avoids planes perpendicular to an axis.
                p.z += p.x + at.z;
            }
            const int sign = orientation(corners[0], corners[1], corners[2], corners[3]);
            if (sign < 0) std::swap(corners[2], corners[3]);
            if (sign != 0) return corners;
        }
    }

private:
    double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }
    std::mt19937_64 random_;
};

TEST(RoundingMargin, IsOnlyFoundWhereAllChildrenAreSound) {
    ThinCells cells(1);
    int with_margin = 0;
    int unsound = 0;
    for (int i = 0; i < 4000; ++i) {
        const auto points = points_and_midpoints(cells.next());
        const bool has_margin = has_rounding_margin(points, cell);
        const bool is_sound = has_sound_children(points);
        EXPECT_TRUE(is_sound || !has_margin);
        with_margin += has_margin ? 1 : 0;
        unsound += is_sound ? 0 : 1;
    }
    EXPECT_GT(with_margin, 1000);
    EXPECT_GT(unsound, 500);
}

TEST(RoundingMargin, IsFoundForMostCellsOfMeshes) {
    const Mesh lattice = test::kuhn(3, 3, 3, 1.0 / 3);
    for (const CellVertices& any : lattice.cells) {
        EXPECT_TRUE(has_rounding_margin(lattice.points, any));
    }
    // A kilometre from the origin, a tenth of a millimetre in size.
    Mesh small = test::kuhn(1, 1, 1, 1e-4);
    for (Point& p : small.points) p = {p.x + 1000, p.y + 1000, p.z + 1000};
    for (const CellVertices& any : small.cells) {
        EXPECT_TRUE(has_rounding_margin(small.points, any));
    }
}

TEST(RoundingMargin, IsNotClaimedWhereNumbersOverflowOrUnderflow) {
    const std::array<Point, 4> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    ASSERT_TRUE(has_rounding_margin(points_and_midpoints(corners), cell));
    for (const double size : {1e-320, 1e-120, 1e120, 1.7e308}) {
        auto scaled = corners;
        for (Point& p : scaled) p = {size * p.x, size * p.y, size * p.z};
        EXPECT_FALSE(has_rounding_margin(points_and_midpoints(scaled), cell)) << size;
    }
}

}  // namespace
}  // namespace octetra::distributed
