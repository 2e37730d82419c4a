#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/edge_order.hpp>

namespace octetra {
namespace {

std::vector<Segment> lattice_segments() {
    std::vector<Point> points;
    for (int i = 0; i < 27; ++i) {
        points.push_back({static_cast<double>(i % 3), static_cast<double>(i / 3 % 3),
                          static_cast<double>(i / 9)});
    }
    std::vector<Segment> segments;
    for (std::size_t a = 0; a < points.size(); ++a) {
        for (std::size_t b = a + 1; b < points.size(); ++b) {
            segments.push_back({points[a], points[b]});
        }
    }
    return segments;
}

TEST(EdgeOrder, IsTotalOnALatticeFullOfTies) {
    const auto segments = lattice_segments();
    for (std::size_t i = 0; i < segments.size(); ++i) {
        EXPECT_FALSE(longer(segments[i], segments[i]));
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_NE(longer(segments[i], segments[j]), longer(segments[j], segments[i]));
        }
    }
}

TEST(EdgeOrder, IsTransitiveOnALatticeFullOfTies) {
    auto segments = lattice_segments();
    std::ranges::sort(segments, longer);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        for (std::size_t j = i + 1; j < segments.size(); ++j) {
            ASSERT_TRUE(longer(segments[i], segments[j]));
        }
    }
}

TEST(EdgeOrder, DoesNotDependOnWhichEndComesFirst) {
    const auto segments = lattice_segments();
    for (const Segment& e : segments) {
        for (const Segment& f : segments) {
            const bool answer = longer(e, f);
            ASSERT_EQ(longer({e.b, e.a}, f), answer);
            ASSERT_EQ(longer(e, {f.b, f.a}), answer);
        }
    }
}

TEST(EdgeOrder, GoesByLengthFirst) {
    EXPECT_TRUE(longer({{0, 0, 0}, {3, 0, 0}}, {{9, 9, 9}, {9, 9, 11}}));
}

TEST(EdgeOrder, GivesATieToTheLargerSmallerEndThenToTheLargerOther) {
    EXPECT_TRUE(longer({{1, 0, 0}, {2, 0, 0}}, {{0, 0, 0}, {1, 0, 0}}));
    EXPECT_TRUE(longer({{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 1, 0}}));
    EXPECT_TRUE(longer({{0, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {0, 0, 1}}));
}

TEST(EdgeOrder, TakesMinusZeroForZero) {
    const Segment e{{0.0, 0, 0}, {1, 0, 0}};
    const Segment f{{-0.0, 0, 0}, {1, 0, 0}};
    EXPECT_FALSE(longer(e, f));
    EXPECT_FALSE(longer(f, e));
}

TEST(EdgeOrder, SumsTheSquaresFromXToZ) {
    const double small = 1.2 * 0x1p-27;  // its square is less than half an ulp of 1, two are more
    EXPECT_EQ(squared_length({{0, 0, 0}, {1, small, small}}), 1);
    EXPECT_EQ(squared_length({{0, 0, 0}, {small, 1, small}}), 1);
    EXPECT_EQ(squared_length({{0, 0, 0}, {small, small, 1}}), 1 + 0x1p-52);
}

TEST(EdgeOrder, RoundsEveryProductByItself) {
    std::mt19937_64 random(1);
    int telling = 0;  // samples on which a fused multiply-add gives another last bit
    for (int i = 0; i < 1000; ++i) {
        const double x = static_cast<double>(random()) * 0x1p-64;
        const double y = static_cast<double>(random()) * 0x1p-64;
        const volatile double xx = x * x;
        const volatile double yy = y * y;
        const volatile double sum = xx + yy;
        ASSERT_EQ(squared_length({{x, y, 0}, {0, 0, 0}}), sum + 0.0);
        if (std::fma(x, x, yy) != sum || std::fma(y, y, xx) != sum) ++telling;
    }
    EXPECT_GT(telling, 100);
}

TEST(EdgeOrder, LengthsBeyondTheLargestDoubleStillCompareStrictly) {
    const Segment e{{0, 0, 0}, {1e200, 0, 0}};
    const Segment f{{0, 0, 0}, {0, 1e200, 0}};
    EXPECT_NE(longer(e, f), longer(f, e));
}

}  // namespace
}  // namespace octetra
