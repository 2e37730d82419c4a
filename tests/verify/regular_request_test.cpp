#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/shape.hpp>
#include <octetra/reference/history.hpp>
#include <octetra/reference/refine.hpp>
#include <octetra/verify/certify_shapes.hpp>
#include <octetra/verify/verify.hpp>

#include "measures/rounded_shapes.hpp"
#include "support/meshes.hpp"
#include "support/refinement.hpp"
#include "verify/together.hpp"
#include "verify/verdicts.hpp"

/// Requests with the regular closure, against the meshes of the reference.
namespace octetra::verify {
namespace {

using test::check_named;
using test::codes_of;

VerifyOptions regular(const Request& request) {
    return {.fast = true, .request = request, .closure = Closure::regular, .kept_per_code = 20};
}

/// The verdict of this process; for every eighth call also of a group, which must agree.
Verdict judged(const Mesh& coarse, const Mesh& fine, const VerifyOptions& options,
               std::size_t count) {
    if (count % 8 != 0) return verify_refinement(coarse, fine, options);
    const auto& sizes = test::all_group_sizes;
    return test::verified_by_all(coarse, fine, options, {sizes[count / 8 % sizes.size()]});
}

/// Requests whose marks, levels or completed families differ.
std::vector<Request> requests() {
    std::vector<Request> all;
    const auto add = [&](const Selection& selection, int levels) {
        for (int level = 0; level <= levels; ++level)
            all.push_back({.selection = selection, .levels = level});
    };
    add({.all = true}, 1);
    add({.spheres = {{{0.4, 0.3, 0.2}, 0.3}}}, 4);
    add({.boxes = {{{0, 0, 0}, {0.3, 0.3, 0.3}}}}, 3);
    add({.cells = {GlobalCell{3}, GlobalCell{10}}}, 2);
    add({.random = RandomShare{0.1, 1}}, 3);
    add({.random = RandomShare{0.02, 2}, .max_volume = 0.02}, 3);
    return all;
}

/// Cubes of six cells; with ties, without, and with midpoints that are rounded.
std::vector<Mesh> coarse_meshes() {
    std::vector<Mesh> meshes{test::kuhn(2, 1, 1, 0.5), test::perturbed_kuhn(2, 0.2, 4),
                             test::perturbed_kuhn(2, 0.3, 5)};
    for (Point& p : meshes[1].points) p = {p.x / 2, p.y / 2, p.z / 2};
    for (Point& p : meshes[2].points) p = {p.x / 3, p.y / 3, p.z / 3};
    return meshes;
}

class RegularRequests : public testing::TestWithParam<std::size_t> {};

TEST_P(RegularRequests, AreConfirmedExactlyIfTheyMakeTheMesh) {
    const Mesh coarse = coarse_meshes()[GetParam()];
    const std::vector<Request> all = requests();
    std::vector<Mesh> meshes;
    for (const Request& request : all) {
        meshes.push_back(
            reference::refine_regularly(coarse, request.selection, request.levels).mesh);
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t k = 0; k < all.size(); ++k) {
            SCOPED_TRACE(fmt::format("the mesh of request {} for request {}", k, i));
            const Verdict verdict = judged(coarse, meshes[k], regular(all[i]), count++);
            ASSERT_EQ(check_named(verdict, "regular closure").status, Status::passed);
            ASSERT_EQ(check_named(verdict, "8T-LE").status,
                      meshes[i] == meshes[k] ? Status::passed : Status::failed);
            ASSERT_EQ(verdict.valid(), meshes[i] == meshes[k]);
            const std::uint64_t explained =
                verdict.count(Code::missing_bisection) + verdict.count(Code::needless_bisection);
            ASSERT_EQ(verdict.valid(), explained == 0) << codes_of(verdict);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(, RegularRequests, testing::Range(std::size_t{0}, std::size_t{3}));

/// The mesh of a request, and histories that differ from it by a single edge or family.
struct RequestedSteps {
    Mesh coarse = test::perturbed_kuhn(2, 0.2, 7);
    Request request{.selection = {.spheres = {{{0.5, 0.5, 0.5}, 0.6}}}, .levels = 2};
    reference::History history = [this] {
        reference::History steps{coarse, {}};
        for (int level = 0; level < request.levels; ++level) {
            const auto refined = reference::replay(steps).back();
            steps = reference::refined_regularly(
                steps, reference::marked_cells(refined, request.selection));
        }
        return steps;
    }();

    [[nodiscard]] Verdict judge(const reference::History& steps, std::size_t count) const {
        return judged(coarse, reference::replay(steps).back().mesh, regular(request), count);
    }
};

TEST(RegularRequest, DetectsEverySingleEdgeTooManyOrTooFew) {
    const RequestedSteps refined;
    ASSERT_EQ(codes_of(refined.judge(refined.history, 0)), "");
    const auto before_last = reference::replay({refined.coarse, {refined.history.steps.front()}});
    std::set<EdgeVertices> candidates;  // edges of the cells that the last step may bisect
    for (const CellVertices& cell : before_last.back().mesh.cells) {
        for (const auto& [i, j] : cell_edges) {
            const auto& [low, high] = std::minmax(cell[i], cell[j]);
            candidates.insert({low, high});
        }
    }
    std::array<int, 2> regular_ones{};  // that the rules permit for other marks
    std::size_t count = 0;
    for (const EdgeVertices& edge : candidates) {
        reference::History other = refined.history;
        auto& step = other.steps.back();
        const auto at = std::ranges::lower_bound(step, edge);
        const bool is_removed = at != step.end() && *at == edge;
        if (is_removed) {
            step.erase(at);
        } else {
            step.insert(at, edge);
        }
        const Verdict verdict = refined.judge(other, count++);
        ASSERT_FALSE(verdict.valid());
        if (check_named(verdict, "regular closure").status != Status::passed) continue;
        ++regular_ones[is_removed ? 0 : 1];
        const Code code = is_removed ? Code::missing_bisection : Code::needless_bisection;
        EXPECT_EQ(codes_of(verdict), name(code));
        EXPECT_EQ(verdict.count(code), 1U);
    }
    EXPECT_GT(regular_ones[0], 0);
    EXPECT_GT(regular_ones[1], 0);
}

TEST(RegularRequest, DetectsAFamilyThatIsCompletedWithoutNeed) {
    const RequestedSteps refined;
    const auto fine = reference::replay(refined.history).back();
    int completed = 0;
    for (CellIndex c{0}; c < fine.mesh.cells.end_index(); ++c) {
        reference::CellMarks marked(fine.mesh.cells.size(), 0);
        marked[c] = 1;
        const auto more = reference::refined_regularly(refined.history, marked);
        if (more.steps.size() > refined.history.steps.size()) continue;  // a cell of the last step
        const Verdict verdict = refined.judge(more, 8 * static_cast<std::size_t>(completed));
        EXPECT_EQ(codes_of(verdict), "needless_bisection");
        EXPECT_EQ(check_named(verdict, "regular closure").status, Status::passed);
        if (++completed == 12) break;
    }
    EXPECT_EQ(completed, 12);
}

TEST(RegularRequest, IsSkippedIfTheMeshIsNotRegular) {
    const Mesh coarse = test::perturbed_kuhn(2, 0.2, 7);
    const Request request{.selection = {.random = RandomShare{0.1, 1}}, .levels = 2};
    const Mesh fine = reference::refine(coarse, request.selection, request.scheme, 2).mesh;
    const Verdict verdict = test::verified_by_all(coarse, fine, regular(request), {3});
    EXPECT_EQ(check_named(verdict, "regular closure").status, Status::failed);
    EXPECT_EQ(check_named(verdict, "8T-LE").status, Status::skipped);
    EXPECT_EQ(check_named(verdict, "8T-LE").note, "regular closure failed");
}

TEST(RegularRequest, HasTheSchemeOfEightOnly) {
    const Mesh mesh = test::kuhn(1, 1, 1);
    const Request request{.selection = {.all = true}, .scheme = Scheme::four};
    EXPECT_THROW((void)verify_refinement(mesh, mesh, regular(request)), InputError);
}

/// The dihedral angle of a cell at its edge k, in degrees.
double dihedral_angle(const Mesh& mesh, const CellVertices& cell, std::size_t k) {
    const auto normal = [&](VertexIndex a, VertexIndex b, VertexIndex c) {
        const auto& p = mesh.points;
        const Point u{p[b].x - p[a].x, p[b].y - p[a].y, p[b].z - p[a].z};
        const Point v{p[c].x - p[a].x, p[c].y - p[a].y, p[c].z - p[a].z};
        return Point{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    };
    const auto dot = [](const Point& u, const Point& v) {
        return u.x * v.x + u.y * v.y + u.z * v.z;
    };
    const auto [i, j] = cell_edges[k];
    const auto [m, n] = cell_edges[5 - k];
    const Point u = normal(cell[i], cell[j], cell[m]);
    const Point v = normal(cell[i], cell[j], cell[n]);
    const double cosine = dot(u, v) / std::sqrt(dot(u, u) * dot(v, v));
    return std::acos(cosine) * 180 / std::numbers::pi;
}

/// The least and the greatest dihedral angle of a cell, in degrees.
std::array<double, 2> extreme_angles(const Mesh& mesh, const CellVertices& cell) {
    std::array<double, 2> extremes{180, 0};
    for (std::size_t k = 0; k < 6; ++k) {
        const double angle = dihedral_angle(mesh, cell, k);
        extremes = {std::min(extremes[0], angle), std::max(extremes[1], angle)};
    }
    return extremes;
}

/// The least solid angle of a cell, in steradians: the angles of faces around a corner less pi.
double least_solid_angle(const Mesh& mesh, const CellVertices& cell) {
    std::array<double, 4> around{};
    for (std::size_t k = 0; k < 6; ++k) {
        const auto [i, j] = cell_edges[k];
        const double angle = dihedral_angle(mesh, cell, k);
        around.at(i) += angle;
        around.at(j) += angle;
    }
    return (std::ranges::min(around) - 180) * std::numbers::pi / 180;
}

TEST(CertifiedShapes, BoundTheAnglesOfEachRegularlyRefinedCell) {
    const Selection some{.random = RandomShare{0.1, 1}};
    const auto note_of = [&](const Mesh& coarse) {
        const Mesh fine = reference::refine_regularly(coarse, some, 3).mesh;
        const Verdict verdict =
            test::verified_by_all(coarse, fine, {.closure = Closure::regular}, {3});
        EXPECT_EQ(codes_of(verdict), "");
        const Check check = check_named(verdict, "certified shapes");
        EXPECT_EQ(check.status, Status::passed);
        return check.note;
    };
    for (const Mesh& coarse : coarse_meshes()) {
        EXPECT_EQ(note_of(coarse),
                  "dihedral angles and eta, exactly; solid angles, in floating point");
    }
    // The greatest angle is 180 degrees when rounded.
    for (const double height : {0x1p-52, 0x1p-53, 0x1p-60, 1e-20, 1e-90}) {
        EXPECT_EQ(
            note_of(test::one_cell({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, height}}})),
            "dihedral angles and eta, exactly; solid angles, in floating point");
    }
    // Far from the origin, rounding of midpoints changes the angles by more than that of bounds.
    Mesh far = test::kuhn(2, 1, 1, 0.5);
    for (Point& p : far.points) p = {p.x / 3 + 1e6, p.y / 3 + 1e6, p.z / 3 + 1e6};
    EXPECT_NE(note_of(far).find("only up to the rounding of midpoints"), std::string::npos);
}

TEST(CertifiedShapes, AreExceededByLongestEdgeRefinement) {
    const Mesh coarse = test::perturbed_kuhn(2, 0.2, 4);
    IndexVector<CellIndex, ShapeBounds> bounds;
    for (const auto& [a, b, c, d] : coarse.cells) {
        const auto& p = coarse.points;
        const CellCertificate certificate = certify_cell({p[a], p[b], p[c], p[d]});
        ASSERT_TRUE(certificate.is_closed);
        bounds.push_back(certificate.bounds);
    }
    const auto [fine, maps] =
        reference::refine(coarse, {.random = RandomShare{0.2, 1}}, Scheme::eight, 3);
    std::array<std::uint64_t, 5> outside{};  // below, above, both, only eta, only solid angles
    constexpr double rounding = 1e-6;
    for (CellIndex c{0}; c < fine.cells.end_index(); ++c) {
        const auto [least, greatest] = extreme_angles(fine, fine.cells[c]);
        const ShapeBounds& bound = bounds[maps.cell_to_parent[c]];
        const bool is_below = least < bound.min_dihedral - rounding;
        const bool is_above = greatest > bound.max_dihedral + rounding;
        const double eta = mean_ratio(test::corners_of(fine, c));
        if (is_below || is_above) {
            ++outside[is_below && is_above ? 2 : is_above ? 1 : 0];
        } else if (eta < bound.min_eta - rounding) {
            ++outside[3];
        } else if (least_solid_angle(fine, fine.cells[c]) < bound.min_solid - rounding) {
            ++outside[4];
        }
    }
    EXPECT_GT(outside[0], 0U);
    EXPECT_GT(outside[1], 0U);
    EXPECT_GT(outside[3], 0U);
    EXPECT_GT(outside[4], 0U);
    const Verdict verdict = test::verified_by_all(coarse, fine, {.closure = Closure::regular}, {3});
    EXPECT_EQ(verdict.count(Code::shape_beyond_certificate),
              std::reduce(outside.begin(), outside.end()));
    EXPECT_EQ(check_named(verdict, "certified shapes").status, Status::failed);
}

/// A solid angle that is certified too large is exceeded, if only by more than rounding explains.
TEST(CertifiedShapes, HaveALeastSolidAngle) {
    const std::array<Point, 4> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    // At the other corners, one dihedral angle is 90 degrees, and two have the cosine 1 / sqrt(3).
    const double least =
        std::numbers::pi / 2 + 2 * std::acos(1 / std::sqrt(3.0)) - std::numbers::pi;
    for (const double scale : {1.0, 0x1p-300, 0x1p300}) {
        Shape<4> shape{.corners = corners};
        for (Point& p : shape.corners) p = {scale * p.x, scale * p.y, scale * p.z};
        EXPECT_TRUE(solid_angles_may_reach(least * (1 - 1e-15), shape));
        EXPECT_FALSE(solid_angles_may_reach(least * (1 + 1e-14), shape));
        shape.rounding = scale * 0x1p-40;
        EXPECT_TRUE(solid_angles_may_reach(least * (1 + 0x1p-40), shape));
        EXPECT_FALSE(solid_angles_may_reach(least * (1 + 0x1p-30), shape));
    }
}

}  // namespace
}  // namespace octetra::verify
