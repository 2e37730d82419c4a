#include <array>
#include <cstdint>
#include <random>
#include <span>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <octetra/core/orientation.hpp>
#include <octetra/core/positive_filter.hpp>

#include "support/meshes.hpp"

namespace octetra {
namespace {

using boost::multiprecision::cpp_rational;

/// The sign from rational arithmetic: slow, and independent of the code under test except for the
/// formula.
int exact_sign(const Point& a, const Point& b, const Point& c, const Point& d) {
    const auto minus = [&](const Point& p) {
        return std::array<cpp_rational, 3>{cpp_rational(p.x) - cpp_rational(a.x),
                                           cpp_rational(p.y) - cpp_rational(a.y),
                                           cpp_rational(p.z) - cpp_rational(a.z)};
    };
    const auto u = minus(b);
    const auto v = minus(c);
    const auto w = minus(d);
    const cpp_rational determinant = u[0] * (v[1] * w[2] - v[2] * w[1]) -
                                     u[1] * (v[0] * w[2] - v[2] * w[0]) +
                                     u[2] * (v[0] * w[1] - v[1] * w[0]);
    return determinant.sign();
}

TEST(Orientation, OfTheUnitCornerIsPositive) {
    EXPECT_EQ(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
    EXPECT_EQ(orientation({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}), -1);
    EXPECT_EQ(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 7, 0}), 0);
}

TEST(Orientation, IsRightForEveryTetrahedronOfASmallLattice) {
    std::array<Point, 27> p;
    for (int i = 0; i < 27; ++i) {
        p[static_cast<std::size_t>(i)] = {
            static_cast<double>(i % 3), static_cast<double>(i / 3 % 3), static_cast<double>(i / 9)};
    }
    for (const Point& b : p) {
        for (const Point& c : p) {
            for (const Point& d : p) {
                const Point& a = p[13];
                const auto determinant =
                    (b.x - 1) * ((c.y - 1) * (d.z - 1) - (c.z - 1) * (d.y - 1)) -
                    (b.y - 1) * ((c.x - 1) * (d.z - 1) - (c.z - 1) * (d.x - 1)) +
                    (b.z - 1) * ((c.x - 1) * (d.y - 1) - (c.y - 1) * (d.x - 1));
                ASSERT_EQ(orientation(a, b, c, d), determinant > 0 ? 1 : determinant < 0 ? -1 : 0);
            }
        }
    }
}

TEST(Orientation, IsRightWithinAFewUlpsOfAPlane) {
    std::mt19937_64 random(1);
    int flat = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto ulps = [&](double x) {
            return x + static_cast<double>(static_cast<int>(random() % 5) - 2) * 0x1p-53;
        };
        // Four points near the plane x + y + z = 1.5.
        const Point a{ulps(0.5), ulps(0.5), ulps(0.5)};
        const Point b{ulps(0.75), ulps(0.5), ulps(0.25)};
        const Point c{ulps(0.25), ulps(0.75), ulps(0.5)};
        const Point d{ulps(0.5), ulps(0.375), ulps(0.625)};
        const int sign = exact_sign(a, b, c, d);
        if (sign == 0) ++flat;
        ASSERT_EQ(orientation(a, b, c, d), sign);
    }
    EXPECT_GT(flat, 10) << "the sample should contain flat ones too";
}

/// Three points with full mantissas, and one that rounding moves off their plane.
std::array<Point, 4> nearly_flat(std::mt19937_64& random) {
    const auto unit = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
    const auto point = [&] { return Point{unit() - 0.5, unit() * 0.125, unit()}; };
    const Point a = point();
    const Point b = point();
    const Point c = point();
    const double s = 2 * unit() - 0.5;
    const double t = 2 * unit() - 0.5;
    const auto between = [&](double p, double q, double r) {
        return p + s * (q - p) + t * (r - p);
    };
    return {a, b, c, {between(a.x, b.x, c.x), between(a.y, b.y, c.y), between(a.z, b.z, c.z)}};
}

TEST(Orientation, IsRightNearPlanesThroughPointsOfAllDigits) {
    // Here differences round as well, and the determinant has an error of up to three times 2^-53
    // of its terms: a filter with a smaller bound gives about 80 wrong answers.
    std::mt19937_64 random(5);
    for (int i = 0; i < 20000; ++i) {
        const auto [a, b, c, d] = nearly_flat(random);
        ASSERT_EQ(orientation(a, b, c, d), exact_sign(a, b, c, d)) << "sample " << i;
    }
}

TEST(Orientation, IsRightAtAllMagnitudesMixed) {
    std::mt19937_64 random(2);
    const auto coordinate = [&]() -> double {
        const double mantissa = 1 + static_cast<double>(random() % 1024) / 1024;
        const int exponent = static_cast<int>(random() % 2090) - 1070;
        const double x = std::ldexp(mantissa, exponent);
        return random() % 8 == 0 ? 0.0 : random() % 2 == 0 ? x : -x;
    };
    const auto point = [&] { return Point{coordinate(), coordinate(), coordinate()}; };
    for (int i = 0; i < 5000; ++i) {
        const Point a = point();
        const Point b = point();
        const Point c = point();
        const Point d = point();
        ASSERT_EQ(orientation(a, b, c, d), exact_sign(a, b, c, d)) << "sample " << i;
    }
}

TEST(Orientation, IsRightWhereProductsUnderflowAndAreMultipliedUpAgain) {
    const Point a{0, 0, 0};
    const Point b{1e-200, 0, 0};
    const Point c{0, 1e-200, 0};
    const Point d{0, 0, 1e300};
    EXPECT_EQ(orientation(a, b, c, d), 1);
    EXPECT_EQ(orientation(a, c, b, d), -1);
}

TEST(Orientation, ChangesSignWithEveryExchangeOfTwoCorners) {
    std::mt19937_64 random(3);
    const auto point = [&] {
        return Point{static_cast<double>(random() % 7), static_cast<double>(random() % 7),
                     static_cast<double>(random() % 7) * 1e-17};
    };
    for (int i = 0; i < 2000; ++i) {
        std::array<Point, 4> p{point(), point(), point(), point()};
        const int sign = orientation(p[0], p[1], p[2], p[3]);
        for (std::size_t j = 0; j < 4; ++j) {
            for (std::size_t k = j + 1; k < 4; ++k) {
                auto q = p;
                std::swap(q[j], q[k]);
                ASSERT_EQ(orientation(q[0], q[1], q[2], q[3]), -sign);
            }
        }
    }
}

bool is_sure_of(const Point& a, const Point& b, const Point& c, const Point& d) {
    PositiveFilter filter;
    filter.add(std::array{a, b, c, d});
    return filter.is_surely_positive(a, b, c, d);
}

TEST(PositiveFilter, IsSureOfAllCellsOfAMeshThatAreNotNearlyFlat) {
    const Mesh mesh = test::perturbed_kuhn(6, 0.2, 3);
    PositiveFilter filter;
    filter.add(std::span(mesh.points).first(5));
    filter.add(std::span(mesh.points).subspan(5));
    EXPECT_EQ(filter.point_count(), mesh.points.size());
    for (const auto& [a, b, c, d] : mesh.cells) {
        const auto& p = mesh.points;
        EXPECT_TRUE(filter.is_surely_positive(p[a], p[b], p[c], p[d]));
        EXPECT_FALSE(filter.is_surely_positive(p[a], p[b], p[d], p[c]));
    }
}

TEST(PositiveFilter, IsUncertainWhereRoundingMakesTheResultPositive) {
    std::mt19937_64 random(6);
    for (int i = 0; i < 20000; ++i) {
        const auto [a, b, c, d] = nearly_flat(random);
        ASSERT_FALSE(is_sure_of(a, b, c, d) && exact_sign(a, b, c, d) <= 0) << "sample " << i;
    }
}

TEST(PositiveFilter, IsNotSureWhereProductsUnderflowOrOverflow) {
    // The smallest double is 2^-1074: products of 0.6 and 0.9 times that round to it.
    const Point a{0, 0, 0};
    const Point b{0x1p-537, 0, 0};
    const Point c{0, 0.6 * 0x1p-537, 0x1p1000};
    const Point d{0, 0.9 * 0x1p-537, 1.4 * 0x1p1000};
    ASSERT_EQ(exact_sign(a, b, c, d), -1);
    EXPECT_FALSE(is_sure_of(a, b, c, d));

    const Point far_x{0x1p1000, 0, 0};
    const Point far_y{0, 0x1p1000, 0};
    EXPECT_FALSE(is_sure_of(a, far_x, far_y, {0, 0, 1}));
}

}  // namespace
}  // namespace octetra
