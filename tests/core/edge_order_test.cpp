#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

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

TEST(EdgeOrder, IsByLengthFirst) {
    EXPECT_TRUE(longer({{0, 0, 0}, {3, 0, 0}}, {{9, 9, 9}, {9, 9, 11}}));
}

TEST(EdgeOrder, BreaksTiesByTheLargerSmallerEndThenByTheLargerOther) {
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
    const double small = 1.2 * 0x1p-27;  // its square is below half an ulp of 1, twice that above
    EXPECT_EQ(squared_length({{0, 0, 0}, {1, small, small}}), 1);
    EXPECT_EQ(squared_length({{0, 0, 0}, {small, 1, small}}), 1);
    EXPECT_EQ(squared_length({{0, 0, 0}, {small, small, 1}}), 1 + 0x1p-52);
}

TEST(EdgeOrder, RoundsEveryProductSeparately) {
    std::mt19937_64 random(1);
    int telling = 0;  // samples whose last bit differs with a fused multiply-add
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

/// Binary64 arithmetic with unlimited exponents, for this test only.
using Unlimited = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<53, boost::multiprecision::digit_base_2, void,
                                         std::int32_t, -100000, 100000>,
    boost::multiprecision::et_off>;

Unlimited unlimited_squared_length(const Segment& s) {
    const Unlimited dx = Unlimited(s.a.x) - Unlimited(s.b.x);
    const Unlimited dy = Unlimited(s.a.y) - Unlimited(s.b.y);
    const Unlimited dz = Unlimited(s.a.z) - Unlimited(s.b.z);
    const Unlimited xx = dx * dx;
    const Unlimited yy = dy * dy;
    const Unlimited zz = dz * dz;
    const Unlimited sum = xx + yy;
    return sum + zz;
}

/// A segment whose coordinates have several bits and are at most 2^exponent; often nearly as long
/// as another one.
Segment draw_segment(std::mt19937_64& random, int exponent) {
    const int bits = random() % 2 == 0 ? 52 : 2;
    const auto coordinate = [&] {
        const auto value = static_cast<double>(random() % (std::uint64_t{1} << bits));
        return std::scalbn(random() % 2 == 0 ? value : -value, exponent - bits);
    };
    return {{coordinate(), coordinate(), coordinate()}, {coordinate(), coordinate(), coordinate()}};
}

TEST(EdgeOrder, IsByLengthsWithUnlimitedExponents) {
    std::mt19937_64 random(1);
    int ties = 0;
    for (const int exponent :
         {-1070, -1040, -1022, -1000, -540, -530, -512, -470, -450, -400, 0, 500, 513, 600, 1023}) {
        for (int i = 0; i < 2000; ++i) {
            const Segment e = draw_segment(random, exponent);
            const Segment f = draw_segment(random, exponent - static_cast<int>(random() % 3));
            const auto length_e = unlimited_squared_length(e);
            const auto length_f = unlimited_squared_length(f);
            if (length_e == length_f) {
                ++ties;
                continue;
            }
            ASSERT_EQ(longer(e, f), length_e > length_f) << exponent;
            ASSERT_EQ(longer(f, e), length_e < length_f) << exponent;
        }
    }
    EXPECT_GT(ties, 50);
}

TEST(EdgeOrder, IsByLengthsWhereCoordinatesDifferByManyMagnitudes) {
    std::mt19937_64 random(1);
    const auto coordinate = [&] {
        const auto bits = static_cast<double>(random() % 8);
        return std::scalbn(bits, static_cast<int>(random() % 120) * 17 - 1074);
    };
    for (int i = 0; i < 20000; ++i) {
        const Segment e{{coordinate(), coordinate(), coordinate()}, {}};
        const Segment f{{coordinate(), coordinate(), coordinate()}, {}};
        const auto length_e = unlimited_squared_length(e);
        const auto length_f = unlimited_squared_length(f);
        if (length_e == length_f) continue;
        ASSERT_EQ(longer(e, f), length_e > length_f);
    }
}

TEST(EdgeOrder, DoesNotChangeWhenAllIsMultipliedByAPowerOfTwo) {
    const auto segments = lattice_segments();
    for (const int exponent : {-1074, -1022, -540, -450, 510, 600, 1021}) {
        auto scaled = segments;
        for (Segment& s : scaled) {
            for (Point* const p : {&s.a, &s.b}) {
                *p = {std::scalbn(p->x, exponent), std::scalbn(p->y, exponent),
                      std::scalbn(p->z, exponent)};
            }
        }
        for (std::size_t i = 0; i < segments.size(); ++i) {
            for (std::size_t j = 0; j < segments.size(); ++j) {
                ASSERT_EQ(longer(scaled[i], scaled[j]), longer(segments[i], segments[j]));
            }
        }
    }
}

/// The smaller squares of a sum lack digits if squares are close to the smallest normal numbers;
/// nearly equal lengths round differently.
TEST(EdgeOrder, DoesNotChangeWhereOnlyTheSmallerSquaresLoseDigits) {
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> digits(1, 2);
    for (int round = 0; round < 20'000; ++round) {
        const double x = digits(random);
        const double y = std::scalbn(digits(random), -static_cast<int>(random() % 30));
        const double z = std::scalbn(digits(random), -static_cast<int>(random() % 30));
        const Segment e{{}, {x, y, z}};
        const Segment f{{}, {z, y, x}};  // the same squares, summed in another order
        for (const int exponent : {-511, -508, -500, -480}) {
            const auto scaled = [&](const Segment& s) {
                return Segment{{},
                               {std::scalbn(s.b.x, exponent), std::scalbn(s.b.y, exponent),
                                std::scalbn(s.b.z, exponent)}};
            };
            ASSERT_EQ(longer(scaled(e), scaled(f)), longer(e, f)) << x << ' ' << y << ' ' << z;
        }
    }
}

TEST(EdgeOrder, HoldsOfTheLargestCoordinatesThatThereCanBe) {
    const double most = std::numeric_limits<double>::max() / 2;
    const Segment diagonal{{-most, -most, -most}, {most, most, most}};
    const Segment side{{-most, -most, -most}, {most, most, 0}};
    EXPECT_TRUE(longer(diagonal, side));
    EXPECT_FALSE(longer(side, diagonal));
}

}  // namespace
}  // namespace octetra
