#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <octetra/core/check_selection.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/selection.hpp>

#include "support/meshes.hpp"
#include "support/thrown.hpp"

namespace octetra {
namespace {

constexpr GlobalCell any_cell{0};
const Corners unit{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}};  // centroid (1, 1, 1)

TEST(Selection, MarksNothingByDefault) { EXPECT_FALSE(marks({}, unit, 0, any_cell)); }

TEST(Selection, OfAllMarksEveryCell) { EXPECT_TRUE(marks({.all = true}, unit, 0, any_cell)); }

TEST(Selection, OfASphereNeedsTheCentroidStrictlyNearerThanTheRadius) {
    EXPECT_FALSE(marks({.spheres = {{{1, 1, 0}, 1}}}, unit, 0, any_cell));
    EXPECT_TRUE(marks({.spheres = {{{1, 1, 0}, 1.0000001}}}, unit, 0, any_cell));
    EXPECT_FALSE(marks({.spheres = {{{0, 0, 0}, 1.7}}}, unit, 0, any_cell));
}

TEST(Selection, OfABoxTakesItsBorderIn) {
    EXPECT_TRUE(marks({.boxes = {{{1, 1, 1}, {1, 1, 1}}}}, unit, 0, any_cell));
    EXPECT_FALSE(marks({.boxes = {{{1.1, 0, 0}, {9, 9, 9}}}}, unit, 0, any_cell));
    EXPECT_FALSE(marks({.boxes = {{{0, 0, 0}, {9, 9, 0.9}}}}, unit, 0, any_cell));
}

TEST(Selection, OfABoxBoundsEveryCoordinateFromBothSides) {
    const Box around{{0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}};
    EXPECT_TRUE(marks({.boxes = {around}}, unit, 0, any_cell));
    for (double Point::*coordinate : {&Point::x, &Point::y, &Point::z}) {
        Box beyond = around;
        beyond.low.*coordinate = 1.25;
        EXPECT_FALSE(marks({.boxes = {beyond}}, unit, 0, any_cell));
        Box before = around;
        before.high.*coordinate = 0.75;
        EXPECT_FALSE(marks({.boxes = {before}}, unit, 0, any_cell));
    }
}

TEST(Selection, OfARegionIsByTag) {
    EXPECT_TRUE(marks({.regions = {3, -7}}, unit, -7, any_cell));
    EXPECT_FALSE(marks({.regions = {3, -7}}, unit, 7, any_cell));
}

TEST(Selection, OfListedCellsIsByTheCellOfTheInput) {
    const Selection listed{.cells = {GlobalCell{2}, GlobalCell{5}}};
    EXPECT_TRUE(marks(listed, unit, 0, GlobalCell{5}));
    EXPECT_FALSE(marks(listed, unit, 0, GlobalCell{3}));
}

TEST(Selection, ByVolumeMarksLargerCells) {
    EXPECT_FALSE(marks({.max_volume = 64.0 / 6}, unit, 0, any_cell));
    EXPECT_TRUE(marks({.max_volume = 10.6}, unit, 0, any_cell));
}

TEST(Selection, CriteriaAddUp) {
    const Selection both{.spheres = {{{9, 9, 9}, 1}}, .regions = {4}};
    EXPECT_TRUE(marks(both, unit, 4, any_cell));
    EXPECT_FALSE(marks(both, unit, 5, any_cell));
}

TEST(Selection, AtRandomTakesAboutItsShare) {
    const Mesh mesh = test::perturbed_kuhn(10, 0.1, 5);
    for (const double share : {0.0, 0.01, 0.3, 0.9, 1.0}) {
        const Selection selection{.random = RandomShare{share, 17}};
        const auto marked = std::ranges::count_if(mesh.cells, [&](const CellVertices& cell) {
            const Corners corners{mesh.points[cell[0]], mesh.points[cell[1]], mesh.points[cell[2]],
                                  mesh.points[cell[3]]};
            return marks(selection, corners, 0, any_cell);
        });
        const auto count = static_cast<double>(mesh.cells.size());
        const double deviation = std::sqrt(count * share * (1 - share));
        EXPECT_NEAR(static_cast<double>(marked), share * count, 4 * deviation) << share;
    }
}

TEST(Selection, AtRandomDrawsOtherCellsForAnotherSeed) {
    const Mesh mesh = test::kuhn(4, 4, 4);
    std::size_t different = 0;
    for (const CellVertices& cell : mesh.cells) {
        const Corners corners{mesh.points[cell[0]], mesh.points[cell[1]], mesh.points[cell[2]],
                              mesh.points[cell[3]]};
        const bool first = marks({.random = RandomShare{0.5, 1}}, corners, 0, any_cell);
        const bool second = marks({.random = RandomShare{0.5, 2}}, corners, 0, any_cell);
        if (first != second) ++different;
    }
    EXPECT_GT(different, mesh.cells.size() / 3);
    EXPECT_LT(different, 2 * mesh.cells.size() / 3);
}

TEST(Selection, AtRandomTakesMinusZeroForZero) {
    Corners negative = unit;
    for (Point& p : negative) {
        for (double* c : {&p.x, &p.y, &p.z}) *c = *c == 0 ? -0.0 : *c;
    }
    for (std::uint64_t seed = 0; seed < 64; ++seed) {
        const Selection drawn{.random = RandomShare{0.5, seed}};
        EXPECT_EQ(marks(drawn, negative, 0, any_cell), marks(drawn, unit, 0, any_cell));
    }
}

Corners scaled(Corners corners, double factor) {
    for (Point& p : corners) p = {p.x * factor, p.y * factor, p.z * factor};
    return corners;
}

TEST(Selection, ComparesDistancesThatHaveNoSquares) {
    for (const double factor : {1e-320, 1e-170, 1e-100, 1.0, 1e100, 1e160, 1e307}) {
        const Corners cell = scaled(unit, factor);
        const Point centre = centroid(cell);
        EXPECT_EQ(centre.x, centre.y);
        EXPECT_NEAR(centre.x / factor, 1, 0.01);
        const auto marked = [&](double radius) {
            return marks({.spheres = {{{}, radius * factor}}}, cell, 0, any_cell);
        };
        EXPECT_TRUE(marked(1.8)) << factor;
        EXPECT_FALSE(marked(1.7)) << factor;
    }
    // The sum of two of these coordinates overflows.
    const Corners huge{{{1.5e308, 0, 0}, {1.6e308, 1, 0}, {1.7e308, 0, 1}, {1.6e308, 1, 1}}};
    EXPECT_EQ(centroid(huge).x, 1.6e308);
    EXPECT_TRUE(
        marks({.spheres = {{{-1e308, 0, 0}, 1.79e308}, {{0, 0, 0}, 1.7e308}}}, huge, 0, any_cell));
    EXPECT_FALSE(marks({.spheres = {{{-1e308, 0, 0}, 1.79e308}}}, huge, 0, any_cell));
}

TEST(Selection, ComparesVolumesThatNoDoubleHolds) {
    const auto marked = [&](const Corners& cell, double limit) {
        return marks({.max_volume = limit}, cell, 0, any_cell);
    };
    const double largest = std::numeric_limits<double>::max();
    EXPECT_TRUE(marked(scaled(unit, 1e160), largest));
    EXPECT_TRUE(marked(scaled(unit, 1e-170), 0));
    EXPECT_FALSE(marked(scaled(unit, 1e-170), std::numeric_limits<double>::denorm_min()));
    // Although a product of two lengths underflows or overflows.
    const Corners needle{{{0, 0, 0}, {4e250, 0, 0}, {0, 4e-170, 0}, {0, 0, 4e-170}}};
    EXPECT_TRUE(marked(needle, 1.06e-89));
    EXPECT_FALSE(marked(needle, 1.07e-89));
    const Corners wafer{{{0, 0, 0}, {4e-250, 0, 0}, {0, 4e170, 0}, {0, 0, 4e170}}};
    EXPECT_TRUE(marked(wafer, 1.06e91));
    EXPECT_FALSE(marked(wafer, 1.07e91));
}

TEST(Selection, DoesNotDependOnTheOrderOfTheCorners) {
    std::mt19937_64 random(11);
    const auto number = [&] { return static_cast<double>(random()) * 0x1p-64; };
    for (int i = 0; i < 500; ++i) {
        Corners corners;
        for (Point& p : corners) p = {number(), number(), number()};
        std::ranges::sort(corners, std::less<>{});
        const Point centre = centroid(corners);
        const double size = volume(corners);
        const Selection drawn{.random = RandomShare{0.5, 3}};
        const bool marked = marks(drawn, corners, 0, any_cell);
        while (std::next_permutation(corners.begin(), corners.end())) {
            ASSERT_EQ(centroid(corners), centre);
            ASSERT_EQ(volume(corners), size);
            ASSERT_EQ(marks(drawn, corners, 0, any_cell), marked);
        }
    }
}

TEST(Selection, OfASphereWithoutEndIsEverything) {
    const Corners corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(marks({.spheres = {{{5, 5, 5}, infinity}}}, corners, 0, GlobalCell{0}));
    EXPECT_FALSE(marks({.spheres = {{{5, 5, 5}, std::nan("")}}}, corners, 0, GlobalCell{0}));
}

std::string refused(const Selection& selection) {
    return test::thrown_by<InputError>([&] { check(selection); });
}

TEST(Selection, IsRefusedAsTheCommandLineRefusesIt) {
    const double nan = std::nan("");
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(refused({.spheres = {{{1, 2, 3}, 4}, {{0, 0, 0}, -1}}}),
              "sphere: the radius is negative: 0,0,0,-1");
    EXPECT_EQ(refused({.spheres = {{{nan, 0, 0}, 1}}}),
              "sphere takes 4 finite numbers as X,Y,Z,R, not 'nan,0,0,1'");
    EXPECT_EQ(refused({.spheres = {{{0, 0, 0}, nan}}}),
              "sphere takes 4 finite numbers as X,Y,Z,R, not '0,0,0,nan'");
    EXPECT_EQ(refused({.spheres = {{{0, 0, 0}, infinity}}}),
              "sphere takes 4 finite numbers as X,Y,Z,R, not '0,0,0,inf'");
    EXPECT_EQ(refused({.boxes = {{{0, 0, 0}, {1, 1, infinity}}}}),
              "box takes 6 finite numbers as X0,Y0,Z0,X1,Y1,Z1, not '0,0,0,1,1,inf'");
    EXPECT_EQ(refused({.boxes = {{{0, 2, 0}, {1, 1, 1}}}}),
              "box: each coordinate of the first corner must be at most that of the second corner: "
              "0,2,0,1,1,1");
    EXPECT_EQ(refused({.random = RandomShare{2, 0}}), "random takes a number from 0 to 1, not '2'");
    EXPECT_EQ(refused({.random = RandomShare{nan, 0}}),
              "random takes a number from 0 to 1, not 'nan'");
    EXPECT_EQ(refused({.random = RandomShare{1e-310, 0}}),
              "random takes a number from 0 to 1, not '1e-310'; it is out of range");
    EXPECT_EQ(refused({.max_volume = -1}), "max_volume takes a number above 0, not '-1'");
    EXPECT_EQ(refused({.max_volume = 0}), "max_volume takes a number above 0, not '0'");
    EXPECT_EQ(refused({.max_volume = nan}), "max_volume takes a number above 0, not 'nan'");
    const Selection smallest{.spheres = {{{0, 0, 0}, 0}},
                             .boxes = {{{0, 0, 0}, {0, 0, 0}}},
                             .random = RandomShare{1, 0},
                             .max_volume = std::numeric_limits<double>::denorm_min()};
    EXPECT_NO_THROW(check(smallest));
}

}  // namespace
}  // namespace octetra
