#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <octetra/core/orientation.hpp>

#include "exact/angles.hpp"
#include "exact/mean_ratio.hpp"
#include "exact/measures.hpp"
#include "exact/predicates.hpp"

/// Decisions in floating point and in integers of fixed size, compared with exact ones close to
/// where they cannot decide. Random, with the seed in the name of a failure; OCTETRA_FILTERS_SEED
/// repeats one.
namespace octetra::verify {
namespace {

std::uint64_t seed() {
    const char* given = std::getenv("OCTETRA_FILTERS_SEED");
    return given != nullptr ? std::strtoull(given, nullptr, 10) : std::random_device{}();
}

class Filters : public testing::Test {
protected:
    double number() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
    Point point() { return {number(), number(), number()}; }
    /// The point a + x (b - a) + y (c - a), rounded: in the plane of the three, or close to it.
    static Point in_plane(const Point& a, const Point& b, const Point& c, double x, double y) {
        const auto at = [&](double p, double q, double r) { return p + x * (q - p) + y * (r - p); };
        return {at(a.x, b.x, c.x), at(a.y, b.y, c.y), at(a.z, b.z, c.z)};
    }
    /// Moves a coordinate by up to `most` units in the last place.
    double nudged(double x, std::uint64_t most) {
        std::uint64_t steps = random_() % (most + 1);
        const double towards = random_() % 2 == 0 ? -2 : 2;
        for (; steps > 0; --steps) x = std::nextafter(x, towards);
        return x;
    }
    Point nudged(const Point& p, std::uint64_t most) {
        return {nudged(p.x, most), nudged(p.y, most), nudged(p.z, most)};
    }
    static Point times(const Point& p, int exponent) {
        return {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
    }

    const std::uint64_t seed_ = seed();
    std::mt19937_64 random_{seed_};
};

/// Core's orientation is another implementation.
TEST_F(Filters, OfOrientationDecideAsExactArithmeticOrNotAtAll) {
    int decided = 0;
    int undecided = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Point a = point();
        const Point b = point();
        const Point c = point();
        const Point d = nudged(in_plane(a, b, c, 3 * number(), 3 * number()), 1U << (i % 8));
        for (const int exponent : {0, -340, -350, 330}) {
            const std::array<Point, 4> p{times(a, exponent), times(b, exponent), times(c, exponent),
                                         times(d, exponent)};
            const int expected = orientation(p[0], p[1], p[2], p[3]);
            const auto found = exact::clear_orientation(p[0], p[1], p[2], p[3]);
            ASSERT_TRUE(!found || *found == expected) << "seed " << seed_;
            Arithmetic arithmetic;
            ASSERT_EQ(exact::orientation(p[0], p[1], p[2], p[3], arithmetic), expected) << seed_;
            if (exponent == 0) ++(found ? decided : undecided);
        }
    }
    EXPECT_GT(decided, 1000) << "seed " << seed_;
    EXPECT_GT(undecided, 1000) << "seed " << seed_;
}

TEST_F(Filters, OfOrientationDoNotDecideFlatCells) {
    for (int i = 0; i < 1000; ++i) {
        const Point a = point();
        const Point b = point();
        EXPECT_EQ(exact::clear_orientation(a, b, a, point()), std::nullopt) << "seed " << seed_;
        EXPECT_EQ(exact::clear_orientation(a, b, midpoint(a, b), midpoint(b, a)), std::nullopt);
    }
    const double largest = std::numeric_limits<double>::max();
    EXPECT_EQ(exact::clear_orientation({-largest, 0, 0}, {largest, 0, 0}, {0, largest, 0},
                                       {0, 0, largest}),
              std::nullopt);
}

/// A sum for another largest coordinate uses integers of any length.
TEST_F(Filters, OfVolumesSumAsIntegersOfAnyLength) {
    for (int i = 0; i < 2000; ++i) {
        const int exponent = std::array{0, -800, 300, -1060}[static_cast<std::size_t>(i % 4)];
        exact::VolumeSum fast;
        exact::VolumeSum slow;
        fast.clear(std::ldexp(1.0, exponent));
        slow.clear();
        for (int k = 0; k < 10; ++k) {
            std::array<Point, 4> corners;
            for (Point& p : corners) {
                // Some coordinates need more bits than the integers have.
                const double size = random_() % 8 == 0 ? 0x1p-12 : 1;
                p = times({number(), number() * size, number()}, exponent);
            }
            if (k % 3 == 0) corners[0] = corners[1];
            if (k % 3 == 1) corners[2] = {1.5 * std::ldexp(1.0, exponent), 0, 0};
            if (k % 2 == 0) {
                fast.add(corners);
                slow.add(corners);
            } else {
                fast.subtract(corners);
                slow.subtract(corners);
            }
            EXPECT_EQ(fast.rounded(), slow.rounded()) << "seed " << seed_;
        }
        exact::NumberSum difference;
        difference.add_exactly(fast.exactly());
        difference.subtract_exactly(slow.exactly());
        ASSERT_TRUE(difference.is_within(0)) << "seed " << seed_;
    }
}

/// Right triangles with an angle of about 30 degrees, of coordinates with few bits, so that
/// products of four fit into integers. `whole` has no smaller angle than 60 degrees by a rounding.
TEST_F(Filters, OfAnglesDecideAsExactArithmetic) {
    const std::array<Point, 3> whole{
        {{0, 0, 0}, {0x1p13, 0, 0}, {0x1p12, 0x1p12 * std::sqrt(3), 0}}};
    int less = 0;
    constexpr int cases = 20'000;
    for (int i = 0; i < cases; ++i) {
        const auto integer = [&](double x) { return std::round(x); };
        const double angle = 3.2 * number();
        const double length = 1 + (1U << (4 + random_() % 8));
        const double x = integer(length * std::cos(angle));
        const double y = integer(length * std::sin(angle));
        const double h = 1 / std::sqrt(3.0);
        const std::array<Point, 3> piece{
            {{0, 0, 0}, {x, y, 0}, {integer(-h * y), integer(h * x), 0}}};
        // cos(angle)^2 > 3/4 at the corner piece[1] or elsewhere means less than 30 degrees.
        bool is_less = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const Point& p = piece[k];
            const Point& q = piece[(k + 1) % 3];
            const Point& r = piece[(k + 2) % 3];
            const auto dot = [&](const Point& s, const Point& t) {
                return static_cast<std::int64_t>((s.x - p.x) * (t.x - p.x) +
                                                 (s.y - p.y) * (t.y - p.y));
            };
            const std::int64_t n = dot(q, r);
            is_less = is_less || (n > 0 && 4 * n * n > 3 * dot(q, q) * dot(r, r));
        }
        Arithmetic arithmetic;
        EXPECT_EQ(exact::keeps_half_of_smallest_angle(piece, whole, arithmetic), !is_less)
            << "seed " << seed_;
        less += is_less ? 1 : 0;
    }
    EXPECT_GT(less, cases / 5) << "seed " << seed_;
    EXPECT_LT(less, cases - cases / 5) << "seed " << seed_;
}

TEST(MeanRatio, IsComparedExactly) {
    const std::array<Point, 4> of_a_cube{{{0, 0, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}}};
    Arithmetic arithmetic;
    const auto is_less = [&](const std::array<Point, 4>& cell, double limit) {
        return exact::is_mean_ratio_less(cell, limit, arithmetic);
    };
    for (const double scale : {1.0, 0x1p-900, 0x1p500}) {
        for (const double far : {0.0, 0x1p30}) {
            std::array<Point, 4> cell = of_a_cube;
            for (Point& p : cell) p = {(p.x + far) * scale, p.y * scale, p.z * scale};
            EXPECT_FALSE(is_less(cell, 1)) << scale << ' ' << far;
            EXPECT_TRUE(is_less(cell, std::nextafter(1.0, 2.0)));
            cell[3].y += 0x1p-20 * scale;  // any other cell has a smaller one
            EXPECT_TRUE(is_less(cell, 1));
            EXPECT_FALSE(is_less(cell, 1 - 0x1p-20));
        }
    }
    // Here d = 1 and s = 9.
    const std::array<Point, 4> corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const double eta = std::cbrt(432.0 / 729);
    EXPECT_TRUE(is_less(corner, std::nextafter(eta, 1.0)));
    EXPECT_FALSE(is_less(corner, std::nextafter(eta, 0.0)));
    const long double limit = eta;
    EXPECT_EQ(is_less(corner, eta), 729 * (limit * limit * limit) > 432);
    EXPECT_GT(arithmetic.exact, 0U);
    EXPECT_GT(arithmetic.filtered, 0U);
}

}  // namespace
}  // namespace octetra::verify
