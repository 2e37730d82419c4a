#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/reference/refine.hpp>
#include <octetra/verify/verify.hpp>

#include "exact/measures.hpp"
#include "measures/sums.hpp"
#include "mesh/checks.hpp"
#include "refinement/checks.hpp"
#include "support/manifest.hpp"
#include "support/meshes.hpp"
#include "verify/mutations.hpp"
#include "verify/together.hpp"
#include "verify/verdicts.hpp"

/// What is right passes, whoever made it and however it is numbered; and the sums of volumes and
/// areas would show what descent might overlook.
namespace octetra::verify {
namespace {

using test::codes_of;

const std::vector<Scheme> schemes{Scheme::eight, Scheme::four, Scheme::two};

std::vector<test::CorpusEntry> entries_with_files() {
    auto entries = test::different_meshes();
    std::erase_if(entries, [](const auto& entry) { return !entry.content.contains("file"); });
    return entries;
}

class CorpusRefinement : public testing::TestWithParam<test::CorpusEntry> {};

TEST_P(CorpusRefinement, IsValidAndTheOneThatWasAskedFor) {
    const Mesh coarse =
        read_mesh(test::corpus_folder() / GetParam().content["file"].get<std::string>());
    const std::vector<Selection> selections{{.all = true}, {.random = RandomShare{0.3, 1}}};
    for (const Selection& selection : selections) {
        for (const Scheme scheme : schemes) {
            for (const int levels : {0, 1, 2}) {
                reference::Refinement fine;
                try {
                    fine = reference::refine(coarse, selection, scheme, levels);
                } catch (const InputError&) {
                    continue;  // rounding
                }
                const Verdict verdict = test::judged_by_all(
                    coarse, fine.mesh,
                    {.request = Request{selection, scheme, levels}, .maps = &fine.maps});
                ASSERT_EQ(codes_of(verdict), "");
                for (const Check& check : verdict.checks) {
                    EXPECT_NE(check.status, Status::failed) << check.name;
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(, CorpusRefinement, testing::ValuesIn(entries_with_files()),
                         test::corpus_name);

TEST(Refinement, IsValidThroughThreeLevelsOfShakenLattices) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Mesh coarse = test::shaken_kuhn(2, 0.2, seed);
        const Request request{{.random = RandomShare{0.1, seed}}, Scheme::eight, 3};
        const Mesh fine =
            reference::refine(coarse, request.selection, request.scheme, request.levels).mesh;
        const Verdict verdict = test::judged_by_all(coarse, fine, {.request = request});
        EXPECT_EQ(codes_of(verdict), "");
        EXPECT_EQ(verdict.facts.rounding_bound, 0);  // on a grid that has room for the halves
        EXPECT_EQ(codes_of(test::judged_by_all(fine)), "");
    }
}

/// Vertices, cells and corners in another order.
Mesh renumbered(const Mesh& mesh, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<std::size_t> order(mesh.points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random);
    Mesh result;
    result.points.resize(mesh.points.size());
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        result.points[VertexIndex{order[v.value()]}] = mesh.points[v];
    }
    for (CellVertices cell : mesh.cells) {
        for (VertexIndex& v : cell) v = VertexIndex{order[v.value()]};
        std::rotate(cell.begin(), cell.begin() + 1, cell.begin() + 3);  // an even permutation
        result.cells.push_back(cell);
    }
    std::shuffle(result.cells.begin(), result.cells.end(), random);
    return result;
}

TEST(Refinement, IsFoundFromGeometryHoweverItIsNumbered) {
    const Mesh coarse = test::shaken_kuhn(2, 0.2, 5);
    const Request request{{.spheres = {{{0, 0, 0}, 1.5}}}, Scheme::eight, 2};
    const Mesh fine = reference::refine(coarse, request.selection, request.scheme, 2).mesh;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Verdict verdict =
            test::judged_by_all(coarse, renumbered(fine, seed), {.request = request});
        EXPECT_EQ(codes_of(verdict), "");
    }
}

/// Cuts every cell into eight at all its midpoints, four of them round a diagonal of the octahedron
/// that is left: what others call red refinement (Bey).
Mesh red_refined(const Mesh& coarse, std::size_t diagonal) {
    Mesh fine{.points = coarse.points};
    std::map<EdgeVertices, VertexIndex> midpoints;
    const auto half = [&](VertexIndex a, VertexIndex b) {
        const auto [at, is_new] = midpoints.try_emplace({std::min(a, b), std::max(a, b)});
        if (is_new) at->second = fine.points.append(midpoint(fine.points[a], fine.points[b]));
        return at->second;
    };
    const auto append = [&](const CellVertices& cell) {
        const auto& p = fine.points;
        fine.cells.push_back(cell);
        if (orientation(p[cell[0]], p[cell[1]], p[cell[2]], p[cell[3]]) < 0) {
            test::flip_cell(fine, CellIndex{fine.cells.size() - 1});
        }
    };
    for (const CellVertices& v : coarse.cells) {
        for (std::size_t corner = 0; corner < 4; ++corner) {
            CellVertices cell = v;
            for (std::size_t k = 0; k < 4; ++k) {
                if (k != corner) cell[k] = half(v[corner], v[k]);
            }
            append(cell);
        }
        const auto [a, b] = cell_edges[diagonal];
        const auto [c, d] = cell_edges[5 - diagonal];
        const std::array<VertexIndex, 4> round{half(v[a], v[c]), half(v[b], v[c]), half(v[b], v[d]),
                                               half(v[a], v[d])};
        for (std::size_t k = 0; k < 4; ++k) {
            append({half(v[a], v[b]), half(v[c], v[d]), round[k], round[(k + 1) % 4]});
        }
    }
    return fine;
}

TEST(Refinement, MayCutCellsIntoEightAtOnce) {
    for (const Mesh& coarse : {test::one_cell(test::tie_free_corners), test::kuhn(2, 1, 1)}) {
        for (const std::size_t first : {0U, 1U, 2U}) {
            for (const std::size_t second : {0U, 1U, 2U}) {
                const Mesh fine = red_refined(red_refined(coarse, first), second);
                const Verdict verdict = test::judged_by_all(coarse, fine);
                EXPECT_EQ(codes_of(verdict), "") << first << second;
                EXPECT_EQ(verdict.facts.deepest, 6);
            }
        }
    }
}

TEST(Refinement, OfAnotherMeshIsRefused) {
    const Mesh coarse = test::kuhn(2, 1, 1);
    EXPECT_FALSE(test::judged_by_all(coarse, test::kuhn(1, 1, 1)).valid());
    EXPECT_FALSE(test::judged_by_all(test::kuhn(1, 1, 1), coarse).valid());
    EXPECT_FALSE(test::judged_by_all(coarse, test::shaken_kuhn(2, 0.1, 1)).valid());
    EXPECT_FALSE(test::judged_by_all(coarse, Mesh{}).valid());
    EXPECT_FALSE(test::judged_by_all(Mesh{}, coarse).valid());
    EXPECT_TRUE(test::judged_by_all(Mesh{}, Mesh{}).valid());
    EXPECT_TRUE(test::judged_by_all(coarse, coarse).valid());
}

/// Two triangulations of one cube, both valid, neither a refinement of the other.
TEST(Refinement, OfTheSameSolidOtherwiseCutIsRefused) {
    const Mesh coarse = test::kuhn(1, 1, 1);
    Mesh mirrored = coarse;
    for (Point& p : mirrored.points) p.x = 1 - p.x;
    for (CellIndex c{0}; c < mirrored.cells.end_index(); ++c) test::flip_cell(mirrored, c);
    EXPECT_TRUE(test::judged_by_all(mirrored).valid());
    EXPECT_EQ(codes_of(test::judged_by_all(coarse, mirrored)), "not_tiled");
}

/// At a crack, vertices of different cells lie at one place, and the two sides are refined each by
/// itself.
TEST(Refinement, MayBeFinerOnOneSideOfACrack) {
    const Mesh coarse = test::mesh_of(
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
        {{0, 1, 2, 3}, {4, 5, 6, 7}});
    const Request request{{.cells = {GlobalCell{1}}}, Scheme::eight, 2};
    const Mesh fine = reference::refine(coarse, request.selection, request.scheme, 2).mesh;
    EXPECT_EQ(codes_of(test::judged_by_all(coarse, fine, {.request = request})), "");

    Mesh closed = fine;  // one side's corner taken for the other's
    for (CellVertices& cell : closed.cells) {
        for (VertexIndex& v : cell) v = v == VertexIndex{4} ? VertexIndex{0} : v;
    }
    EXPECT_FALSE(test::judged_by_all(coarse, closed).valid());
}

/// A lattice slit half through: the edges from the slit's tip to its two sides lie in one place,
/// too.
TEST(Refinement, MayHaveACrackWithATip) {
    Mesh coarse = test::kuhn(2, 2, 2);
    std::map<VertexIndex, VertexIndex> upper;  // of the slit's vertices, those of the cells above
    for (VertexIndex v{0}; v < VertexIndex{27}; ++v) {
        const Point p = coarse.points[v];
        if (p.z == 1 && p.x < 1) upper[v] = coarse.points.append(p);
    }
    for (CellVertices& cell : coarse.cells) {
        const auto is_above = [&](VertexIndex v) { return coarse.points[v].z > 1; };
        if (std::none_of(cell.begin(), cell.end(), is_above)) continue;
        for (VertexIndex& v : cell) {
            if (upper.contains(v)) v = upper[v];
        }
    }
    for (const Scheme scheme : schemes) {
        const Request request{{.all = true}, scheme, 2};
        const Mesh fine = reference::refine(coarse, request.selection, scheme, 2).mesh;
        EXPECT_EQ(codes_of(test::judged_by_all(coarse, fine, {.request = request})), "");
    }
}

/// Two cells whose edges cross in their middles, which pass for a coarse mesh. Bisected by one
/// vertex there, they hang together, which no coarse cells do.
TEST(Refinement, MayNotJoinWhatOnlyCrosses) {
    const Mesh coarse = test::mesh_of({{0, 0, 0},
                                       {4, 0, 0},
                                       {2, -1, 3},
                                       {2, 1, 3},
                                       {2, -1, 0},
                                       {2, 1, 0},
                                       {1, 0, -3},
                                       {3, 0, -3}},
                                      {{0, 1, 2, 3}, {4, 5, 6, 7}});
    Mesh apart = coarse;
    test::bisect_edge(apart, VertexIndex{0}, VertexIndex{1});
    test::bisect_edge(apart, VertexIndex{4}, VertexIndex{5});
    Mesh joined = apart;
    for (CellVertices& cell : joined.cells) {
        std::replace(cell.begin(), cell.end(), VertexIndex{9}, VertexIndex{8});
    }
    joined.points.pop_back();
    EXPECT_EQ(codes_of(test::judged_by_all(coarse, joined)), "not_a_midpoint");
    EXPECT_EQ(codes_of(test::judged_by_all(coarse, apart)), "coincident_vertices");
}

/// Two cells of the coarse mesh have corners of their own at one place, half way along the edge of
/// a third cell. What the coarse mesh may have there, the fine one may not add to.
TEST(Refinement, MayNotUseThePlaceOfACoarseVertex) {
    const Mesh coarse = test::mesh_of({{0, 0, 0},
                                       {4, 0, 0},
                                       {2, -1, 3},
                                       {2, 1, 3},
                                       {2, 0, 0},
                                       {1, 0, -3},
                                       {2, 1, -3},
                                       {1, 1, -4},
                                       {2, 0, 0},
                                       {3, 0, -3},
                                       {2, -1, -3},
                                       {3, -1, -4}},
                                      {{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10, 11}});
    EXPECT_EQ(codes_of(verify_refinement(coarse, coarse)), "");
    Mesh fine = coarse;
    test::bisect_edge(fine, VertexIndex{0}, VertexIndex{1});
    EXPECT_EQ(codes_of(verify_refinement(coarse, fine)), "coincident_vertices");
    for (CellVertices& cell : fine.cells) {
        std::replace(cell.begin(), cell.end(), VertexIndex{12}, VertexIndex{4});
    }
    fine.points.pop_back();
    EXPECT_EQ(codes_of(verify_refinement(coarse, fine)), "not_a_midpoint");
}

TEST(Refinement, IsJudgedAtAllMagnitudes) {
    for (const double side : {0x1p-900, 0x1p-300, 0x1p300, 0x1p900}) {
        const Mesh coarse = test::kuhn(2, 1, 1, side);
        const Mesh fine = test::kuhn(4, 2, 2, side / 2);
        const Verdict verdict = test::judged_by_all(coarse, fine, {.min_dihedral = 45});
        EXPECT_EQ(codes_of(verdict), "") << side;
        EXPECT_NEAR(verdict.angles->min_dihedral, 45, 1e-12);
        EXPECT_EQ(codes_of(test::judged_by_all(fine)), "") << side;
        Mesh moved = fine;
        test::shift_by_an_ulp(moved, VertexIndex{44});  // of the far corner
        EXPECT_FALSE(test::judged_by_all(coarse, moved).valid()) << side;
    }
}

/// Where volumes are less than the least number, bounds on them still bound something.
TEST(Refinement, IsJudgedWhereWhatRoundingMovesIsLessThanAnyNumber) {
    for (const double scale : {1e-103, 1e-120, 1e-160}) {
        Mesh coarse = test::shaken_kuhn(2, 0.3, 4);
        for (Point& p : coarse.points) p = {p.x * scale, p.y * scale, p.z * scale};
        const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, 2).mesh;
        const Verdict verdict = test::judged_by_all(coarse, fine);
        EXPECT_GT(verdict.facts.rounded_midpoints, 0U);
        EXPECT_EQ(codes_of(verdict), "") << scale;
    }
}

TEST(Refinement, BoundsWhatRoundingHasMoved) {
    Mesh coarse = test::kuhn(1, 1, 1);
    for (Point& p : coarse.points) p = {p.x / 3 + 1000, p.y / 7, p.z / 11};
    const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, 3).mesh;
    const Verdict verdict = test::judged_by_all(coarse, fine);
    EXPECT_EQ(codes_of(verdict), "");
    EXPECT_GT(verdict.facts.rounded_midpoints, 0U);
    EXPECT_GT(verdict.facts.rounding_bound, 0x1p-45);  // an ulp at 1000 is 2^-43
    EXPECT_LE(verdict.facts.rounding_bound, 4 * 0x1p-44);
}

// ---- sums, which descent implies; a wrong descent must show in them
// ------------------------------

struct Descended {
    Descended(Mesh from, Mesh to) : coarse_mesh(std::move(from)), fine_mesh(std::move(to)) {
        (void)check_well_formed(coarse, findings);
        (void)check_orientation(coarse, findings);
        (void)check_well_formed(fine, findings);
        (void)check_orientation(fine, findings);
        const Places places(fine_mesh.points);
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

TEST(Refinement, OfWhichAHalfIsMissingIsNotBlamedOnTheMidpoint) {
    const Mesh coarse = test::one_cell(test::regular_corners);
    Mesh half = reference::refine(coarse, {.all = true}, Scheme::two, 1).mesh;
    ASSERT_EQ(half.cells.size(), 2U);
    half.cells.pop_back();
    const Verdict verdict = test::judged_by_all(coarse, half);
    EXPECT_EQ(codes_of(verdict), "not_tiled");
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
    const Verdict refined = test::judged_by_all(coarse, fine);
    EXPECT_EQ(codes_of(refined), "");
    const Verdict alone = test::judged_by_all(fine);
    expect(refined.volumes, {{-2, 7.0 / 6}, {3, 5.0 / 6}}, true);
    expect(alone.volumes, {{-2, 7.0 / 6}, {3, 5.0 / 6}}, false);
    expect(refined.areas, {{4, 9.5}, {7, 0.5}}, true);
    expect(alone.areas, {{4, 9.5}, {7, 0.5}}, false);
}

TEST(SumsByTag, AreThoseOfCellsFarAwayAndOfAnyRegions) {
    Mesh mesh = test::shaken_kuhn(3, 0.2, 6);
    for (Point& p : mesh.points) p = {p.x + 1e6 / 3, p.y * 1e-5, p.z - 1e9 / 7};
    std::map<Marker, exact::VolumeSum> expected;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        mesh.regions.push_back(static_cast<Marker>(c.value() * 7 % 5));
        const CellVertices& v = mesh.cells[c];
        expected[mesh.regions[c]].add(
            {mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]});
    }
    const auto volumes = test::judged_by_all(mesh).volumes;
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

/// A face's smallest angle is halved but for the rounding of a midpoint, and then halved again.
TEST(FaceAnglesOfRoundedMeshes, AreJudgedAlikeAtAllMagnitudes) {
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
        return test::judged_by_all(scaled(coarse, factor), scaled(fine, factor));
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
