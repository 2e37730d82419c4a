#include "mark/selection_bounds.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace octetra::distributed {
namespace {

/// The sides of the bounds beyond which all corners lie, as bits.
int sides_in_common(const SelectionBounds& reach, const Corners& corners) {
    int sides = 0b111111;
    for (const Point& corner : corners) sides &= reach.sides_beyond(corner);
    return sides;
}

/// Random cells of a size, and spheres whose surface passes through or near their centroids.
void expect_marked_only_where_it_may_be(double size, double offset) {
    SCOPED_TRACE(testing::Message() << "size " << size << ", offset " << offset);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> place(-size, size);
    const auto point = [&] {
        return Point{place(random) + offset, place(random) + offset, place(random) + offset};
    };
    int marked = 0;
    for (int i = 0; i < 20000; ++i) {
        Corners corners{point(), point(), point(), point()};
        if (i % 3 == 0) corners = {corners[0], corners[0], corners[0], corners[0]};
        const Point centre = centroid(corners);
        Point c = point();
        if (i % 5 == 0) c = {c.x, centre.y, centre.z};  // where the sphere extends farthest
        const double radius = std::hypot(centre.x - c.x, centre.y - c.y, centre.z - c.z);
        const Selection sphere{.spheres = {{c, radius * (1 + (i % 7 - 3) * 2e-16)}}};
        const Selection box{.boxes = {{centre, centre}}};
        for (const Selection& selection : {sphere, box}) {
            const SelectionBounds reach(selection);
            if (!marks(selection, corners, 0, GlobalCell{0})) {
                ASSERT_FALSE(reach.is_wholly_inside(box_of(corners))) << "case " << i;
                continue;
            }
            ++marked;
            ASSERT_TRUE(may_be_marked(selection, box_of(corners))) << "case " << i;
            ASSERT_EQ(sides_in_common(reach, corners), 0) << "case " << i;
            ASSERT_FALSE(reach.is_out_of_reach(box_of(corners))) << "case " << i;
        }
    }
    EXPECT_GT(marked, 20000);
}

TEST(SelectionBounds, NeverExcludeAMarkedCell) {
    for (const double size : {1.0, 1e-9, 1e-165, 3e-320, 1e153, 1e170, 8e307}) {
        expect_marked_only_where_it_may_be(size, 0);
    }
    expect_marked_only_where_it_may_be(1e-12, 1);
    expect_marked_only_where_it_may_be(1e300, 1e307);
}

TEST(SelectionBounds, ExcludeDistantCells) {
    const Box corners{{0, 0, 0}, {1, 1, 1}};
    EXPECT_FALSE(may_be_marked({.spheres = {{{2, 0.5, 0.5}, 0.999}}}, corners));
    EXPECT_TRUE(may_be_marked({.spheres = {{{2, 0.5, 0.5}, 1.001}}}, corners));
    EXPECT_FALSE(may_be_marked({.boxes = {{{0, 0, 1.001}, {1, 1, 2}}}}, corners));
    EXPECT_TRUE(may_be_marked({.boxes = {{{0, 0, 0.999}, {1, 1, 2}}}}, corners));
}

TEST(SelectionBounds, EndsWhereSpheresAndBoxesEnd) {
    const SelectionBounds reach({.spheres = {{{0, 0, 0}, 1}}, .boxes = {{{2, 2, 2}, {3, 3, 3}}}});
    const auto is_beyond_one_side = [&](const Point& a, const Point& b) {
        return sides_in_common(reach, {a, b, a, b}) != 0;
    };
    const Point inside{0, 0, 0};
    for (double Point::*x : {&Point::x, &Point::y, &Point::z}) {
        for (const auto& [within, beyond] : {std::pair{-0.999, -1.001}, {2.999, 3.001}}) {
            Point near = inside;
            Point far = inside;
            near.*x = within;
            far.*x = beyond;
            EXPECT_FALSE(is_beyond_one_side(near, near)) << within;
            EXPECT_TRUE(is_beyond_one_side(far, far)) << beyond;
            EXPECT_FALSE(is_beyond_one_side(far, inside)) << beyond;
        }
    }
    // Each corner is beyond a side, but no side is common to all.
    const Corners around{{{-5, 0, 0}, {5, 0, 0}, {0, 5, 0}, {0, -5, 1}}};
    EXPECT_EQ(sides_in_common(reach, around), 0);
    EXPECT_EQ(SelectionBounds({.spheres = {{{0, 0, 0}, infinity}}}).sides_beyond({1e308, 0, 0}), 0);
}

TEST(SelectionBounds, PassOverCellsAndBoxesBeyondOneSide) {
    const SelectionBounds reach({.spheres = {{{0, 0, 0}, 1}}});
    const Corners cell{{{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (double Point::*x : {&Point::x, &Point::y, &Point::z}) {
        for (const auto& [shift, is_out] : {std::pair{1.99, false}, {2.01, true}}) {
            for (const double sign : {-1.0, 1.0}) {
                Corners moved = cell;
                for (Point& p : moved) p.*x += sign * shift;
                EXPECT_EQ(reach.is_out_of_reach(box_of(moved)), is_out);
            }
        }
    }
}

TEST(SelectionBounds, FindCellsThatAreWhollyInside) {
    const SelectionBounds reach(
        {.spheres = {{{5, 5, 5}, 1}, {{0, 0, 0}, 2}}, .boxes = {{{-9, -9, -9}, {-8, -8, -8}}}});
    for (const auto& [x, is_inside] : {std::pair{1.99, true}, {2.01, false}}) {
        EXPECT_EQ(reach.is_wholly_inside({{-x, 0, 0}, {0, 0, 0}}), is_inside);
        EXPECT_EQ(reach.is_wholly_inside({{0, 0, 0}, {0, x, 0}}), is_inside);
        EXPECT_EQ(reach.is_wholly_inside({{0, 0, -0.1}, {0, 0, x}}), is_inside);
    }
    EXPECT_FALSE(reach.is_wholly_inside({{-1.5, -1.5, 0}, {0, 0, 0}}));  // one corner is outside
    EXPECT_TRUE(reach.is_wholly_inside({{-9, -9, -9}, {-8, -8, -8}}));
    EXPECT_FALSE(reach.is_wholly_inside({{-9, -9, -9}, {-8, -8, -7.9}}));
}

}  // namespace
}  // namespace octetra::distributed
