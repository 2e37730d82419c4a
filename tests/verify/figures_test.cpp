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

/// Angles, and decisions about them, compared with known values of some shapes.
namespace octetra::verify {
namespace {

using test::codes_of;

struct Shape {
    std::array<Point, 4> corners;
    double eta_cubed;
    double min_dihedral;
    double max_dihedral;
};

const double regular_dihedral = std::acos(1.0 / 3) * 180 / M_PI;

const std::vector<Shape> shapes{
    {test::regular_corners, 1, regular_dihedral, regular_dihedral},
    {test::kuhn_corners, 54.0 / 125, 45, 90},
    {test::cube_corner, 16.0 / 27, std::acos(std::sqrt(1.0 / 3)) * 180 / M_PI, 90},
    {test::sommerville_corners, 108.0 / 125, 60, 90},
};

TEST(Angles, AreThoseOfKnownShapes) {
    for (const Shape& shape : shapes) {
        const Verdict verdict = test::verified_by_all(test::one_cell(shape.corners));
        ASSERT_TRUE(verdict.angles.has_value());
        EXPECT_NEAR(verdict.angles->min_dihedral, shape.min_dihedral, 1e-12);
        EXPECT_NEAR(verdict.angles->max_dihedral, shape.max_dihedral, 1e-12);
        EXPECT_NEAR(verdict.angles->min_eta, std::cbrt(shape.eta_cubed), 1e-15);
    }
    // The corner of a cube is an eighth of the full angle; that of the regular tetrahedron is 3
    // acos(1/3) - pi.
    const Verdict corner = test::verified_by_all(test::one_cell(test::regular_corners));
    EXPECT_NEAR(corner.angles->min_solid, 3 * std::acos(1.0 / 3) - M_PI, 1e-14);
}

bool is_under(const std::array<Point, 4>& corners, double degrees) {
    return !test::verified_by_all(test::one_cell(corners), {.min_dihedral = degrees}).valid();
}

TEST(Angles, AreComparedExactlyAlsoWhereTheyAreEqual) {
    constexpr double up = std::numeric_limits<double>::infinity();
    for (const Shape& shape : {shapes[1], shapes[3]}) {  // 45 and 60 degrees, exactly
        EXPECT_FALSE(is_under(shape.corners, shape.min_dihedral));
        EXPECT_TRUE(is_under(shape.corners, std::nextafter(shape.min_dihedral, up)));
        EXPECT_FALSE(is_under(shape.corners, std::nextafter(shape.min_dihedral, 0)));
    }
    EXPECT_TRUE(is_under(test::regular_corners, std::nextafter(regular_dihedral, up)));
    EXPECT_FALSE(is_under(test::regular_corners, std::nextafter(regular_dihedral, 0)));
    EXPECT_FALSE(is_under(test::kuhn_corners, 0));
    EXPECT_TRUE(is_under(test::kuhn_corners, 180));
}

/// A factor that preserves shapes and makes products of coordinates exceed 53 bits.
constexpr double awkward = 0x1p27 + 1;

TEST(Angles, TakeExactArithmeticOnlyWhereTheyMust) {
    const auto judge = [](std::array<Point, 4> corners) {
        for (Point& p : corners) p = {p.x * awkward, p.y * awkward, p.z * awkward};
        return test::verified_by_all(test::one_cell(corners), {.min_dihedral = 45});
    };
    const Verdict near = judge(test::kuhn_corners);
    const Verdict far = judge(test::regular_corners);
    EXPECT_TRUE(near.valid());
    EXPECT_GT(near.arithmetic.exact, far.arithmetic.exact);
    EXPECT_EQ(far.arithmetic.exact, 0U);
    EXPECT_GT(far.arithmetic.filtered, 0U);
}

TEST(FaceAngles, OfAnEquilateralTriangleMayBeHalvedAndNoMore) {
    Arithmetic arithmetic;
    const double h = std::sqrt(3.0);  // rounded down: the apex is slightly low
    const std::array<Point, 3> whole{{{0, 0, 0}, {2, 0, 0}, {1, h, 0}}};
    const std::array<Point, 3> half{{{0, 0, 0}, {1, 0, 0}, {1, h, 0}}};
    const std::array<Point, 3> less{{{0, 0, 0}, {0.99, 0, 0}, {1, h, 0}}};
    EXPECT_TRUE(exact::keeps_half_of_smallest_angle(whole, whole, arithmetic));
    EXPECT_FALSE(exact::keeps_half_of_smallest_angle(less, half, arithmetic) &&
                 exact::keeps_half_of_smallest_angle(less, whole, arithmetic));
    // The height of an isosceles triangle halves its apex angle exactly.
    constexpr double a = awkward;
    const std::array<Point, 3> isosceles{{{-a, 0, 0}, {a, 0, 0}, {0, 7 * a, 0}}};
    const std::array<Point, 3> exact_half{{{0, 0, 0}, {a, 0, 0}, {0, 7 * a, 0}}};
    const std::array<Point, 3> under{{{0, 0, 0}, {std::nextafter(a, 0), 0, 0}, {0, 7 * a, 0}}};
    const auto exact_before = arithmetic.exact;
    EXPECT_TRUE(exact::keeps_half_of_smallest_angle(exact_half, isosceles, arithmetic));
    EXPECT_FALSE(exact::keeps_half_of_smallest_angle(under, isosceles, arithmetic));
    EXPECT_EQ(arithmetic.exact, exact_before + 2);
}

/// Each cell of a lattice has vertices in its neighbourhood that lie in the plane of one of its
/// faces and beyond another.
TEST(Vertices, ThatAreClearlyBeyondAFaceTakeNoExactArithmeticForTheOthers) {
    Mesh lattice = test::kuhn(3, 3, 3);
    for (Point& p : lattice.points) {
        p = {(p.x + 0.3 * p.y) * awkward / 3, (p.y + 0.7 * p.z) * awkward / 3, p.z * awkward / 3};
    }
    const Verdict verdict = test::verified_by_all(lattice, lattice);
    EXPECT_TRUE(verdict.valid());
    // Volumes of the same points are equal; the area of each boundary face is summed exactly. A few
    // edges are in line with a side of a face.
    EXPECT_GE(verdict.arithmetic.exact, 108U);
    EXPECT_LE(verdict.arithmetic.exact, 120U);
}

/// Half of a smallest angle is at most 30 degrees, so neither a right angle nor one of 45 or 60
/// degrees needs rational arithmetic, although intervals cannot determine the sign of a cosine of
/// 0.
TEST(FaceAngles, AreAcceptedByIntervalsFrom30DegreesUp) {
    constexpr double a = awkward;
    const Point o{0.3 * a, 0.7 * a, -0.9 * a};
    const auto at = [&](double x, double y) { return Point{o.x + x * a, o.y + y * a, o.z}; };
    const std::array<Point, 3> right{at(0, 0), at(1, 0), at(0, 1)};
    const std::array<Point, 3> half{at(0, 0), at(1, 0), at(0.5, 0.5)};
    const std::array<Point, 3> turned{at(0, 0), at(0.6, 0.8), at(-0.8, 0.6)};
    Arithmetic arithmetic;
    for (const auto& piece : {right, half, turned}) {
        for (const auto& whole : {right, half, turned}) {
            EXPECT_TRUE(exact::keeps_half_of_smallest_angle(piece, whole, arithmetic));
        }
    }
    EXPECT_EQ(arithmetic.exact, 0U);
    const std::array<Point, 3> narrow{at(0, 0), at(1, 0), at(1, 0.36)};  // 19.8 degrees
    for (const auto& whole : {right, half, turned}) {                    // of 45 degrees
        EXPECT_FALSE(exact::keeps_half_of_smallest_angle(narrow, whole, arithmetic));
    }
    EXPECT_TRUE(exact::keeps_half_of_smallest_angle(narrow, narrow, arithmetic));
}

TEST(Depths, HaveTheKnownQualitiesOfTheTieFreeExample) {
    const Mesh coarse = test::one_cell(test::tie_free_corners);
    const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, 3).mesh;
    const Verdict verdict = test::verified_by_all(coarse, fine);
    ASSERT_EQ(verdict.by_depth.size(), 1U);
    EXPECT_EQ(verdict.by_depth[0].depth, 9);
    EXPECT_EQ(verdict.by_depth[0].cells, 512U);
    EXPECT_NEAR(verdict.by_depth[0].min_eta, 0.4489, 5e-5);
    EXPECT_NEAR(verdict.coarse_angles->min_eta, 0.9178, 5e-5);
}

TEST(Orientation, IsExactWithinAFewUlpsOfAPlane) {
    Arithmetic arithmetic;
    const Point a{0.1, 0.1, 0.1};
    const Point b{0.7, 0.2, 0.3};
    const Point c{0.3, 0.9, 0.6};
    const Point d{a.x + (b.x - a.x) + (c.x - a.x), a.y + (b.y - a.y) + (c.y - a.y),
                  a.z + (b.z - a.z) + (c.z - a.z)};
    for (int i = -8; i <= 8; ++i) {
        const Point p{d.x, d.y, d.z + i * 0x1p-53};
        EXPECT_EQ(exact::orientation(a, b, c, p, arithmetic), orientation(a, b, c, p)) << i;
        EXPECT_EQ(exact::orientation(b, a, c, p, arithmetic), -orientation(a, b, c, p)) << i;
    }
    EXPECT_GT(arithmetic.exact, 0U);
    EXPECT_EQ(exact::orientation(a, b, c, a, arithmetic), 0);
}

TEST(Facts, CountSingularEdgesAndVertices) {
    const auto facts_of = [](const Mesh& mesh) { return test::verified_by_all(mesh).facts; };
    const Facts cube = facts_of(test::kuhn(2, 2, 2));
    EXPECT_EQ(cube.singular_edges, 0U);
    EXPECT_EQ(cube.singular_vertices, 0U);
    EXPECT_EQ(cube.boundary_faces, 48U);
    EXPECT_EQ(cube.edges, 7U * 8 + 9 * 4 + 3 * 2);
    EXPECT_EQ(cube.faces, 12U * 8 + 6 * 4);

    const std::vector<Point> points{{0, 0, 0},  {1, 0, 0},  {0, 1, 0}, {0, 0, 1},
                                    {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    const Facts at_an_edge = facts_of(test::mesh_of(points, {{0, 3, 1, 2}, {0, 3, 4, 5}}));
    EXPECT_EQ(at_an_edge.singular_edges, 1U);
    EXPECT_EQ(at_an_edge.singular_vertices, 2U);
    const Facts at_a_vertex = facts_of(test::mesh_of(points, {{0, 1, 2, 3}, {0, 4, 5, 6}}));
    EXPECT_EQ(at_a_vertex.singular_edges, 0U);
    EXPECT_EQ(at_a_vertex.singular_vertices, 1U);
}

TEST(Fast, OmitsChecksThatNeedASearchInSpace) {
    const Mesh coarse = test::kuhn(2, 1, 1);
    const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, 1).mesh;
    const Verdict verdict = test::verified_by_all(coarse, fine, {.fast = true});
    EXPECT_EQ(codes_of(verdict), "");
    for (const Check& check : verdict.checks) {
        const bool in_space = check.name == "hanging vertices" ||
                              check.name == "volumes of cells" || check.name == "face angles" ||
                              check.name == "sums by tag";
        EXPECT_EQ(check.status == Status::skipped, in_space) << check.name;
    }
}

TEST(Notes, ReportThatThereAreNoCells) {
    const Check check = test::verified_by_all(Mesh{}).checks[1];
    EXPECT_EQ(check.name, "well-formed");
    EXPECT_EQ(check.note, "there are no cells to check");
    EXPECT_EQ(test::verified_by_all(test::kuhn(1, 1, 1)).checks[1].note, "");
}

TEST(Notes, OfSkippedChecksNameTheFailedOnes) {
    const auto why_not_crossings = [](const Mesh& mesh) {
        const Verdict verdict = test::verified_by_all(mesh);
        EXPECT_EQ(verdict.checks.back().name, "boundary crossings");
        EXPECT_EQ(verdict.checks.back().status, Status::skipped);
        return verdict.checks.back().note;
    };
    Mesh inverted = test::kuhn(2, 1, 1);
    std::swap(inverted.cells[CellIndex{0}][0], inverted.cells[CellIndex{0}][1]);
    EXPECT_EQ(why_not_crossings(inverted), "there are invalid cells");
    Mesh coincident = test::kuhn(2, 1, 1);
    coincident.cells[CellIndex{0}][0] =
        coincident.points.append(coincident.points[coincident.cells[CellIndex{0}][0]]);
    EXPECT_EQ(why_not_crossings(coincident), "there are coincident or hanging vertices");
}

TEST(Notes, OfSkippedSumsAndDescentNameTheChecksThatFailed) {
    Mesh coarse = test::kuhn(2, 1, 1);
    coarse.regions.assign(coarse.cells.size(), 1);
    coarse.point_markers.assign(coarse.points.size(), 1);
    const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, 1).mesh;
    const auto why_not = [&](std::string_view name, const Mesh& mesh) {
        const Verdict verdict = test::verified_by_all(coarse, mesh);
        const auto check = std::ranges::find(verdict.checks, name, &Check::name);
        EXPECT_EQ(check->status, Status::skipped);
        return check->note;
    };
    Mesh wrong = fine;
    wrong.regions[CellIndex{3}] = 7;
    EXPECT_EQ(why_not("sums by tag", wrong), "region tags failed");
    wrong.point_markers[VertexIndex{2}] = 7;
    EXPECT_EQ(why_not("sums by tag", wrong), "region tags, vertex markers failed");
    std::swap(wrong.cells[CellIndex{0}][0], wrong.cells[CellIndex{0}][1]);
    EXPECT_EQ(why_not("descent", wrong), "orientation failed");
    EXPECT_EQ(why_not("sums by tag", wrong), "orientation failed");
}

/// Each process reports its work, from 0 and monotonically within a check.
TEST(Progress, IsReportedForEveryCheckThatRuns) {
    const Mesh coarse = test::kuhn(6, 6, 6);
    const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, 1).mesh;
    std::vector<std::string> told;
    double last = 0;
    std::size_t steps = 0;
    const auto hear = [&](std::string_view check, double share) {
        if (told.empty() || told.back() != check) {
            told.emplace_back(check);
            EXPECT_EQ(share, 0);
        } else {
            EXPECT_GE(share, last) << check;
            ++steps;
        }
        EXPECT_LE(share, 1);
        last = share;
    };
    const Verdict verdict =
        verify_refinement(coarse, fine, {.min_dihedral = 1.0, .progress = hear});
    std::vector<std::string> run;
    for (const Check& check : verdict.checks) {
        if (check.status != Status::skipped) run.push_back(check.name);
    }
    EXPECT_EQ(told, run);
    EXPECT_GT(steps, 40U);
}

TEST(Violations, AreAllCountedWhereNotAllAreKept) {
    Mesh mesh = test::kuhn(2, 2, 2);
    for (CellVertices& cell : mesh.cells) std::swap(cell[0], cell[1]);
    const Verdict verdict = test::verified_by_all(mesh, {.kept_per_code = 3});
    EXPECT_EQ(verdict.count(Code::inverted_cell), 48U);
    EXPECT_EQ(verdict.violations.size(), 3U);
    EXPECT_EQ(test::verified_by_all(mesh).violations.size(), 48U);
}

}  // namespace
}  // namespace octetra::verify
