#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <octetra/core/point.hpp>

namespace octetra {
namespace {

TEST(Midpoint, IsTheSameBitsFromEitherEnd) {
    std::mt19937_64 random(1);
    const auto number = [&] { return static_cast<double>(random()) * 0x1p-64; };
    for (int i = 0; i < 1000; ++i) {
        const Point a{number(), number() * 1e-9, number() * 1e9};
        const Point b{number(), number(), number()};
        const Point m = midpoint(a, b);
        ASSERT_EQ(midpoint(b, a), m);
        ASSERT_EQ(m, (Point{(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2}));
    }
}

TEST(Midpoint, IsFiniteUpToTheLimitOfCoordinates) {
    const double most = std::nextafter(coordinate_limit, 0.0);
    EXPECT_EQ(midpoint({most, -most, 0}, {most, -most, most}), (Point{most, -most, most / 2}));
}

TEST(Mean, IsThatOfAnyFiniteNumbers) {
    const double most = std::numeric_limits<double>::max();
    EXPECT_EQ(mean(most, most), most);
    EXPECT_EQ(mean(-most, -most), -most);
    EXPECT_EQ(mean(most, -most), 0);
    EXPECT_EQ(mean(most, 0x1p+1023), most / 2 + 0x1p+1022);
    EXPECT_EQ(mean(1, 2), 1.5);
    EXPECT_EQ(mean(0x3p-1074, 0x1p-1074), 0x2p-1074);
}

TEST(Point, IsFiniteWhereEveryCoordinateIs) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(is_finite({1, -2, std::numeric_limits<double>::max()}));
    for (const double bad : {infinite, -infinite, nan}) {
        EXPECT_FALSE(is_finite({bad, 0, 0}));
        EXPECT_FALSE(is_finite({0, bad, 0}));
        EXPECT_FALSE(is_finite({0, 0, bad}));
    }
}

TEST(Point, ComparesLexicographically) {
    EXPECT_LT((Point{0, 9, 9}), (Point{1, 0, 0}));
    EXPECT_LT((Point{1, 0, 9}), (Point{1, 1, 0}));
    EXPECT_LT((Point{1, 1, 0}), (Point{1, 1, 1}));
    EXPECT_EQ((Point{0.0, 0, 0}), (Point{-0.0, 0, 0}));
}

}  // namespace
}  // namespace octetra
