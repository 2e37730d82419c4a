#include <algorithm>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/reference/refine.hpp>
#include <octetra/verify/verify.hpp>

#include "exact/measures.hpp"
#include "measures/sums.hpp"
#include "mesh/checks.hpp"
#include "refinement/checks.hpp"
#include "support/meshes.hpp"
#include "verify/mutations.hpp"
#include "verify/together.hpp"
#include "verify/verdicts.hpp"

/// Sums of volumes and areas, which descent implies: a wrong descent must appear in them.
namespace octetra::verify {
namespace {

using test::codes_of;

struct Descended {
    Descended(Mesh from, Mesh to) : coarse_mesh(std::move(from)), fine_mesh(std::move(to)) {
        (void)check_well_formed(coarse, findings);
        (void)check_orientation(coarse, findings);
        (void)check_well_formed(fine, findings);
        (void)check_orientation(fine, findings);
        const PointLookup places(fine_mesh.points);
        Lines lines(fine, places);
        (void)find_coarse_vertices(coarse, fine, places, descent, findings);
        (void)check_descent(coarse, fine, lines, descent, findings);
    }
    std::string codes_of_sums() {
        (void)check_volumes(coarse, fine, descent, findings);
        return codes_of(findings.verdict());
    }

    std::string codes_of_sums_by_tag() {
        (void)check_sums(coarse, fine, descent, findings);
        return codes_of(findings.verdict());
    }

    Mesh coarse_mesh;
    Mesh fine_mesh;
    Findings findings{100};
    JudgedMesh coarse{.mesh = coarse_mesh, .which = Which::coarse};
    JudgedMesh fine{.mesh = fine_mesh};
    Descent descent;
};

class Sums : public testing::Test, public Descended {
protected:
    Sums()
        : Descended(test::kuhn(2, 2, 2),
                    reference::refine(test::kuhn(2, 2, 2), {.all = true}, Scheme::eight, 1).mesh) {}
};

Mesh scaled(Mesh mesh, double factor) {
    for (Point& p : mesh.points) p = {p.x * factor, p.y * factor, p.z * factor};
    return mesh;
}

TEST(SumsOfRoundedMeshes, AreBoundedAtAllMagnitudes) {
    Mesh coarse = test::kuhn(1, 1, 1);
    for (Point& p : coarse.points) p = {p.x / 3 + 1000, p.y / 7, p.z / 11};
    const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, 1).mesh;
    for (const double factor : {0x1p-900, 0x1p-350, 1.0, 0x1p350, 0x1p500, 0x1p900}) {
        Descended right(scaled(coarse, factor), scaled(fine, factor));
        EXPECT_EQ(right.codes_of_sums(), "") << factor;
        EXPECT_GT(right.findings.facts().rounded_midpoints, 0U);
        Descended wrong(scaled(coarse, factor), scaled(fine, factor));
        wrong.descent.parent[CellIndex{0}] = CellIndex{1};
        (void)wrong.codes_of_sums();
        EXPECT_EQ(wrong.findings.verdict().count(Code::wrong_volume), 2U) << factor;
        wrong.fine_mesh.points.back().x *= 2;
        (void)wrong.codes_of_sums();
        EXPECT_GT(wrong.findings.verdict().count(Code::boundary_moved), 0U) << factor;
    }
}

TEST(SumsByTag, OfVolumesAndAreasAreExactAndThoseOfTheCoarseMesh) {
    Mesh coarse = test::kuhn(2, 1, 1);
    test::list_boundary(coarse);
    std::fill(coarse.facet_markers.begin(), coarse.facet_markers.end(), 4);
    coarse.facet_markers[FacetIndex{0}] = 7;
    for (CellIndex c{0}; c < CellIndex{12}; ++c) {
        coarse.regions.push_back(c < CellIndex{5} ? 3 : -2);
    }
    const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, 2).mesh;
    const auto expect = [](const std::vector<TagSum>& sums, std::vector<std::pair<int, double>> of,
                           bool of_refinement) {
        ASSERT_EQ(sums.size(), of.size());
        for (std::size_t i = 0; i < of.size(); ++i) {
            EXPECT_EQ(sums[i].tag, of[i].first);
            EXPECT_DOUBLE_EQ(sums[i].fine, of[i].second);
            EXPECT_DOUBLE_EQ(sums[i].coarse, of_refinement ? of[i].second : 0);
            EXPECT_EQ(sums[i].difference, 0);
        }
    };
    const Verdict refined = test::verified_by_all(coarse, fine);
    EXPECT_EQ(codes_of(refined), "");
    const Verdict alone = test::verified_by_all(fine);
    expect(refined.volumes, {{-2, 7.0 / 6}, {3, 5.0 / 6}}, true);
    expect(alone.volumes, {{-2, 7.0 / 6}, {3, 5.0 / 6}}, false);
    expect(refined.areas, {{4, 9.5}, {7, 0.5}}, true);
    expect(alone.areas, {{4, 9.5}, {7, 0.5}}, false);
}

TEST(SumsByTag, AreThoseOfCellsFarAwayAndOfAnyRegions) {
    Mesh mesh = test::perturbed_kuhn(3, 0.2, 6);
    for (Point& p : mesh.points) p = {p.x + 1e6 / 3, p.y * 1e-5, p.z - 1e9 / 7};
    std::map<Marker, exact::VolumeSum> expected;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        mesh.regions.push_back(static_cast<Marker>(c.value() * 7 % 5));
        const CellVertices& v = mesh.cells[c];
        expected[mesh.regions[c]].add(
            {mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]});
    }
    const auto volumes = test::verified_by_all(mesh).volumes;
    ASSERT_EQ(volumes.size(), 5U);
    for (const TagSum& sum : volumes) EXPECT_EQ(sum.fine, expected[sum.tag].rounded() / 6);
}

TEST_F(Sums, ByTagAreComparedExactlyWhereNothingWasRounded) {
    EXPECT_EQ(codes_of_sums_by_tag(), "");
    fine_mesh.points[VertexIndex{0}].x -= 0x1p-60;  // a corner
    EXPECT_EQ(codes_of_sums_by_tag(), "wrong_sum");
}

TEST_F(Sums, OfAreasByMarkerAreComparedToo) {
    test::list_boundary(coarse_mesh);
    test::list_boundary(fine_mesh);
    for (Mesh* mesh : {&coarse_mesh, &fine_mesh}) {
        std::fill(mesh->facet_markers.begin(), mesh->facet_markers.end(), 4);
    }
    EXPECT_EQ(codes_of_sums_by_tag(), "");
    fine_mesh.facets.pop_back();
    EXPECT_EQ(codes_of_sums_by_tag(), "wrong_sum");
}

TEST(SumsOfRoundedMeshes, ByTagAreBoundedAtAllMagnitudes) {
    Mesh coarse = test::kuhn(1, 1, 1);
    test::list_boundary(coarse);
    for (Point& p : coarse.points) p = {p.x / 3 + 1000, p.y / 7, p.z / 11};
    const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, 2).mesh;
    for (const double factor : {0x1p-900, 0x1p-350, 1.0, 0x1p350, 0x1p900}) {
        Descended sums(scaled(coarse, factor), scaled(fine, factor));
        EXPECT_EQ(sums.codes_of_sums_by_tag(), "") << factor;
        sums.fine_mesh.facet_markers.back() = sums.fine_mesh.facet_markers.front();
        sums.fine_mesh.points.front().x *= 1.0001;
        (void)sums.codes_of_sums_by_tag();
        EXPECT_GE(sums.findings.verdict().count(Code::wrong_sum), 3U) << factor;
    }
}

/// The smallest angle of a face is halved except for the rounding of a midpoint, and then halved
/// again.
TEST(FaceAnglesOfRoundedMeshes, AreJudgedIdenticallyAtAllMagnitudes) {
    const Mesh coarse =
        test::one_cell({{{1 + 0x1p-52, 0, 0}, {1.5, 0, 0}, {1.25, 3, 0}, {1.25, 1, 2}}});
    Mesh halved = coarse;
    test::bisect_edge(halved, VertexIndex{0}, VertexIndex{1});
    Mesh quartered = halved;
    test::bisect_edge(quartered, VertexIndex{0}, VertexIndex{4});
    const auto note_of = [](const Verdict& verdict) {
        for (const Check& check : verdict.checks) {
            if (check.name == "face angles") return check.note;
        }
        return std::string();
    };
    const auto judge = [&](const Mesh& fine, double factor) {
        return test::verified_by_all(scaled(coarse, factor), scaled(fine, factor));
    };
    for (const double factor : {0x1p-990, 0x1p-535, 0x1p-520, 1.0, 0x1p520, 0x1p990}) {
        const Verdict right = judge(halved, factor);
        EXPECT_EQ(codes_of(right), "") << factor;
        EXPECT_EQ(note_of(right), note_of(judge(halved, 1))) << factor;
        EXPECT_THAT(note_of(right), testing::HasSubstr("only up to rounding"));
        EXPECT_EQ(codes_of(judge(quartered, factor)), "face_angle_too_small") << factor;
    }
}

TEST_F(Sums, AreEqualExactly) { EXPECT_EQ(codes_of_sums(), ""); }

TEST_F(Sums, OfVolumesShowAVertexMovedByAnUlpBetweenCells) {
    for (VertexIndex v{27}; v < fine_mesh.points.end_index(); ++v) {
        const Point& p = fine_mesh.points[v];
        if (p.x != 1.5 || p.y != 1 || p.z != 1.5) continue;  // on a face between coarse cells
        fine_mesh.points[v].y = std::nextafter(1.0, 2.0);
    }
    EXPECT_EQ(codes_of_sums(), "wrong_volume");
}

TEST_F(Sums, OfVolumesShowAWrongParent) {
    descent.parent[CellIndex{0}] = CellIndex{1};
    (void)codes_of_sums();
    EXPECT_EQ(findings.verdict().count(Code::wrong_volume), 2U);
}

TEST_F(Sums, OfAreasShowAVertexMovedByAnUlpOutOfTheBoundary) {
    for (Point& p : fine_mesh.points) {
        if (p.x == 0 && p.y == 0.5 && p.z == 0.5) p.x = -0x1p-60;
    }
    EXPECT_EQ(codes_of_sums(), "boundary_moved wrong_volume");
}

}  // namespace
}  // namespace octetra::verify
