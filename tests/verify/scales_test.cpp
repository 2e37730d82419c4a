#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <octetra/reference/refine.hpp>
#include <octetra/verify/verify.hpp>

#include "exact/angles.hpp"
#include "exact/predicates.hpp"
#include "support/meshes.hpp"
#include "verify/together.hpp"
#include "verify/verdicts.hpp"

/// The same mesh with all coordinates multiplied by a power of two: neither verdicts, nor the
/// arithmetic that they take, nor figures of shape change.
namespace octetra::verify {
namespace {

using test::codes_of;

constexpr std::array<int, 6> exponents{-1000, -540, -200, 200, 600, 1000};

Point times(const Point& p, int exponent) {
    return {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
}

Mesh times(Mesh mesh, int exponent) {
    for (Point& p : mesh.points) p = times(p, exponent);
    return mesh;
}

void expect_same_angles(const std::optional<AngleFigures>& a,
                        const std::optional<AngleFigures>& b) {
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) return;
    EXPECT_EQ(a->min_dihedral, b->min_dihedral);
    EXPECT_EQ(a->max_dihedral, b->max_dihedral);
    EXPECT_EQ(a->min_solid, b->min_solid);
    EXPECT_EQ(a->min_eta, b->min_eta);
    EXPECT_EQ(a->min_dihedral_at, b->min_dihedral_at);
}

void expect_same_findings(const Verdict& a, const Verdict& b) {
    EXPECT_EQ(codes_of(a), codes_of(b));
    expect_same_angles(a.angles, b.angles);
    expect_same_angles(a.coarse_angles, b.coarse_angles);
    ASSERT_EQ(a.by_depth.size(), b.by_depth.size());
    for (std::size_t i = 0; i < a.by_depth.size(); ++i) {
        EXPECT_EQ(a.by_depth[i].min_eta, b.by_depth[i].min_eta);
        EXPECT_EQ(a.by_depth[i].min_dihedral, b.by_depth[i].min_dihedral);
    }
}

void expect_same_judgement(const Verdict& a, const Verdict& b) {
    expect_same_findings(a, b);
    EXPECT_EQ(a.arithmetic.filtered, b.arithmetic.filtered);
    EXPECT_EQ(a.arithmetic.exact, b.arithmetic.exact);
}

TEST(Scales, ChangeNeitherVerdictsNorTheArithmeticTheyTakeNorShapes) {
    const Mesh coarse = test::perturbed_kuhn(2, 0.2, 11);
    const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, 2).mesh;
    Mesh broken = fine;
    broken.points[VertexIndex{40}].x += 0.125;
    const VerifyOptions options{.min_dihedral = 20};
    for (const int exponent : exponents) {
        SCOPED_TRACE(exponent);
        for (const Mesh* mesh : {&fine, &std::as_const(broken)}) {
            expect_same_judgement(verify_mesh(times(*mesh, exponent), options),
                                  verify_mesh(*mesh, options));
            expect_same_judgement(
                verify_refinement(times(coarse, exponent), times(*mesh, exponent), options),
                verify_refinement(coarse, *mesh, options));
        }
    }
}

/// Integers times the smallest double, and integers scaled nearly to the largest one. There is no
/// point between neighbours of the former that could be counted in cells, so more arithmetic is
/// needed.
TEST(Scales, MayBeThoseOfTheSmallestAndTheLargestNumbers) {
    const Mesh coarse = test::kuhn(2, 2, 1, 8);
    const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, 1).mesh;
    for (const int exponent : {-1074, 1018}) {
        const Mesh scaled = times(fine, exponent);
        const Verdict verdict = verify_refinement(times(coarse, exponent), scaled);
        expect_same_findings(verdict, verify_refinement(coarse, fine));
        EXPECT_TRUE(verdict.valid()) << codes_of(verdict);
        expect_same_findings(verify_mesh(scaled), verify_mesh(fine));
    }
}

/// Rounding may place another vertex half way between the ends of an edge of one unit that is not
/// its midpoint; the verifier must not search endlessly for the cells that such midpoints would
/// have cut.
TEST(Scales, OfEdgesThatNoNumberHalvesAreJudgedToo) {
    const Mesh mesh =
        test::mesh_of({{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, 1, 1}},
                      {{0, 1, 2, 3}, {1, 2, 3, 4}});
    Mesh tiny = mesh;
    Mesh huge = mesh;
    constexpr double smallest = std::numeric_limits<double>::denorm_min();
    for (Point& p : tiny.points) p = {2 * smallest * p.x, 2 * smallest * p.y, 2 * smallest * p.z};
    for (Point& p : huge.points) p = {0x1p53 + 4 * p.x, 0x1p53 + 4 * p.y, 0x1p53 + 4 * p.z};
    for (const Mesh& coarse : {tiny, huge}) {
        for (const int levels : {1, 2}) {
            const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, levels).mesh;
            EXPECT_EQ(codes_of(verify_refinement(coarse, fine)), "") << levels;
        }
    }
}

/// The difference of two of these coordinates overflows.
TEST(Scales, OfShapesAreNoHindranceWhereDifferencesOverflow) {
    std::array<Point, 4> corners = test::regular_corners;
    for (Point& p : corners) p = times(p, 1023);
    const Verdict verdict = verify_mesh(test::one_cell(corners));
    ASSERT_TRUE(verdict.angles.has_value());
    EXPECT_NEAR(verdict.angles->min_eta, 1, 1e-12);
    EXPECT_NEAR(verdict.angles->min_dihedral, std::acos(1.0 / 3) * 180 / M_PI, 1e-9);
}

/// Scaling the largest coordinate to about 1 would make the smallest vanish, on which the result
/// depends.
TEST(Scales, MayBeMixedWithinOneCell) {
    constexpr double large = 0x1p1000;
    constexpr double small = 0x1p-1074;
    Arithmetic arithmetic;
    const Point o{0, 0, 0};
    const Point b{large, 1, 0};
    const Point d{0, 0, 1};
    for (const double x : {small, -small}) {
        const Point c{x, 0, 0};
        const int expected = x > 0 ? -1 : 1;
        EXPECT_EQ(exact::orientation(o, b, c, d, arithmetic), expected);
        EXPECT_EQ(exact::orientation(b, o, c, d, arithmetic), -expected);
    }
    EXPECT_EQ(exact::orientation(o, b, o, d, arithmetic), 0);

    // The segment ends in the triangle, or by the smallest double before it.
    const std::array<Point, 3> triangle{{{0, -large, -large}, {0, large, -large}, {0, 0, large}}};
    EXPECT_TRUE(exact::meet({Point{large, 0, 0}, Point{0, 0, 0}}, triangle, arithmetic));
    EXPECT_FALSE(exact::meet({Point{large, 0, 0}, Point{small, 0, 0}}, triangle, arithmetic));

    const exact::AngleLimit limit(45);
    // Between the planes z = 0 and y = z, and slightly less.
    const auto is_under = [&](double z) {
        return limit.exceeds_dihedral({0, 0, 0}, {large, 0, 0}, {0, small, 0}, {0, 4 * small, z},
                                      arithmetic);
    };
    EXPECT_FALSE(is_under(4 * small));
    EXPECT_TRUE(is_under(3 * small));
}

}  // namespace
}  // namespace octetra::verify
