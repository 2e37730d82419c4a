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

/// Valid refinements pass, independently of their origin and numbering.
namespace octetra::verify {
namespace {

using test::check_named;
using test::codes_of;

const std::vector<Scheme> schemes{Scheme::eight, Scheme::four, Scheme::two};

std::vector<test::CorpusEntry> entries_with_files() {
    auto entries = test::without_odd_files(test::different_meshes());
    std::erase_if(entries, [](const auto& entry) { return !entry.content.contains("file"); });
    return entries;
}

class CorpusRefinement : public testing::TestWithParam<test::CorpusEntry> {
protected:
    static inline std::size_t judged = 0;  // number of meshes
};

TEST_P(CorpusRefinement, IsValidAndTheOneThatWasAskedFor) {
    const Mesh coarse =
        read_mesh(test::corpus_folder() / GetParam().content["file"].get<std::string>());
    const std::vector<Selection> selections{{.all = true}, {.random = RandomShare{0.3, 1}}};
    for (const Selection& selection : selections) {
        for (const Scheme scheme : schemes) {
            for (const int levels : {0, 1, 2}) {
                if (levels == 0 && (!selection.all || scheme != Scheme::eight)) continue;
                reference::Refinement fine;
                try {
                    fine = reference::refine(coarse, selection, scheme, levels);
                } catch (const InputError&) {
                    continue;  // rounding
                }
                // With this many meshes each group size is combined with all other parameters.
                const int together = test::all_group_sizes[judged++ % test::all_group_sizes.size()];
                const Verdict verdict = test::verified_by_all(
                    coarse, fine.mesh,
                    {.request = Request{selection, scheme, levels}, .maps = &fine.maps},
                    {together});
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
        const Mesh coarse = test::perturbed_kuhn(2, 0.2, seed);
        const Request request{{.random = RandomShare{0.1, seed}}, Scheme::eight, 3};
        const Mesh fine =
            reference::refine(coarse, request.selection, request.scheme, request.levels).mesh;
        const Verdict verdict = test::verified_by_all(coarse, fine, {.request = request});
        EXPECT_EQ(codes_of(verdict), "");
        EXPECT_EQ(verdict.facts.rounding_bound, 0);  // on a grid that can represent the halves
        EXPECT_EQ(codes_of(test::verified_by_all(fine)), "");
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
    const Mesh coarse = test::perturbed_kuhn(2, 0.2, 5);
    const Request request{{.spheres = {{{0, 0, 0}, 1.5}}}, Scheme::eight, 2};
    const Mesh fine = reference::refine(coarse, request.selection, request.scheme, 2).mesh;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Verdict verdict =
            test::verified_by_all(coarse, renumbered(fine, seed), {.request = request});
        EXPECT_EQ(codes_of(verdict), "");
    }
}

/// Cuts every cell into eight at all its midpoints, four of them round a diagonal of the remaining
/// octahedron: red refinement (Bey).
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
                const Verdict verdict = test::verified_by_all(coarse, fine);
                EXPECT_EQ(codes_of(verdict), "") << first << second;
                EXPECT_EQ(verdict.facts.deepest, 6);
            }
        }
    }
}

TEST(Refinement, OfAnotherMeshIsRefused) {
    const Mesh coarse = test::kuhn(2, 1, 1);
    EXPECT_FALSE(test::verified_by_all(coarse, test::kuhn(1, 1, 1)).valid());
    EXPECT_FALSE(test::verified_by_all(test::kuhn(1, 1, 1), coarse).valid());
    EXPECT_FALSE(test::verified_by_all(coarse, test::perturbed_kuhn(2, 0.1, 1)).valid());
    EXPECT_FALSE(test::verified_by_all(coarse, Mesh{}).valid());
    EXPECT_FALSE(test::verified_by_all(Mesh{}, coarse).valid());
    EXPECT_TRUE(test::verified_by_all(Mesh{}, Mesh{}).valid());
    EXPECT_TRUE(test::verified_by_all(coarse, coarse).valid());
}

/// Two triangulations of one cube, both valid, neither a refinement of the other.
TEST(Refinement, OfAnotherTriangulationOfTheSolidIsRefused) {
    const Mesh coarse = test::kuhn(1, 1, 1);
    Mesh mirrored = coarse;
    for (Point& p : mirrored.points) p.x = 1 - p.x;
    for (CellIndex c{0}; c < mirrored.cells.end_index(); ++c) test::flip_cell(mirrored, c);
    EXPECT_TRUE(test::verified_by_all(mirrored).valid());
    EXPECT_EQ(codes_of(test::verified_by_all(coarse, mirrored)), "not_tiled");
}

/// At a crack, vertices of different cells coincide, and the two sides are refined independently.
TEST(Refinement, MayBeFinerOnOneSideOfACrack) {
    const Mesh coarse = test::mesh_of(
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
        {{0, 1, 2, 3}, {4, 5, 6, 7}});
    const Request request{{.cells = {GlobalCell{1}}}, Scheme::eight, 2};
    const Mesh fine = reference::refine(coarse, request.selection, request.scheme, 2).mesh;
    EXPECT_EQ(codes_of(test::verified_by_all(coarse, fine, {.request = request})), "");

    Mesh closed = fine;  // one side's corner taken for the other's
    for (CellVertices& cell : closed.cells) {
        for (VertexIndex& v : cell) v = v == VertexIndex{4} ? VertexIndex{0} : v;
    }
    EXPECT_FALSE(test::verified_by_all(coarse, closed).valid());
}

/// A lattice with a slit half through: the edges from the tip of the slit to its two sides coincide
/// as well.
Mesh lattice_with_slit() {
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
    return coarse;
}

TEST(Refinement, MayHaveACrackWithATip) {
    const Mesh coarse = lattice_with_slit();
    for (const Scheme scheme : schemes) {
        const Request request{{.all = true}, scheme, 2};
        const Mesh fine = reference::refine(coarse, request.selection, scheme, 2).mesh;
        EXPECT_EQ(codes_of(test::verified_by_all(coarse, fine, {.request = request})), "");
    }
}

TEST(Refinement, OfACrackedMeshIsFoundFromGeometryHoweverItIsNumbered) {
    const Mesh coarse = lattice_with_slit();
    const Request request{{.spheres = {{{0, 0, 1.2}, 1}}}, Scheme::eight, 2};
    const Mesh fine = reference::refine(coarse, request.selection, request.scheme, 2).mesh;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Mesh other = renumbered(fine, seed);
        EXPECT_EQ(codes_of(test::verified_by_all(coarse, other, {.request = request})), "");
        Mesh closed = other;  // a vertex of one side taken for one of the other
        std::map<Point, VertexIndex> first;
        for (CellVertices& cell : closed.cells) {
            for (VertexIndex& v : cell) v = first.try_emplace(closed.points[v], v).first->second;
        }
        EXPECT_FALSE(verify_refinement(coarse, closed).valid());
    }
}

TEST(Refinement, MayInheritVerticesOfNoCellWithANote) {
    Mesh coarse = test::kuhn(1, 1, 1);
    coarse.points.push_back({9, 9, 9});
    coarse.points.push_back(coarse.points[VertexIndex{0}]);
    const Request request{{.all = true}, Scheme::eight, 1};
    const Mesh fine = reference::refine(coarse, request.selection, request.scheme, 1).mesh;
    for (const Mesh& other : {fine, renumbered(fine, 1), renumbered(fine, 2)}) {
        const Verdict verdict = test::verified_by_all(coarse, other, {.request = request});
        EXPECT_EQ(codes_of(verdict), "");
        EXPECT_EQ(verdict.facts.unused_vertices, 2U);
        EXPECT_EQ(check_named(verdict, "vertices").note, "2 vertices belong to no cell");
        EXPECT_EQ(check_named(verdict, "hanging vertices").status, Status::passed);
    }
}

/// Two cells whose edges cross in their middles, which are accepted as a coarse mesh. Bisected at
/// one common vertex there, they are joined, which coarse cells never are.
TEST(Refinement, MayNotJoinCellsThatOnlyCross) {
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
    EXPECT_EQ(codes_of(test::verified_by_all(coarse, joined)), "not_a_midpoint");
    EXPECT_EQ(codes_of(test::verified_by_all(coarse, apart)), "coincident_vertices");
}

/// Two cells of the coarse mesh have separate corners at one point, half way along the edge of a
/// third cell. The coarse mesh may have this, but the fine mesh must not add to it.
TEST(Refinement, MayNotCoincideWithACoarseVertex) {
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
        const Verdict verdict = test::verified_by_all(coarse, fine, {.min_dihedral = 45});
        EXPECT_EQ(codes_of(verdict), "") << side;
        EXPECT_NEAR(verdict.angles->min_dihedral, 45, 1e-12);
        EXPECT_EQ(codes_of(test::verified_by_all(fine)), "") << side;
        Mesh moved = fine;
        test::shift_by_an_ulp(moved, VertexIndex{44});  // of the far corner
        EXPECT_FALSE(test::verified_by_all(coarse, moved).valid()) << side;
    }
}

/// Bounds on volumes remain valid if the volumes underflow.
TEST(Refinement, IsJudgedWhereTheVolumeMovedByRoundingUnderflows) {
    for (const double scale : {1e-103, 1e-120, 1e-160}) {
        Mesh coarse = test::perturbed_kuhn(2, 0.3, 4);
        for (Point& p : coarse.points) p = {p.x * scale, p.y * scale, p.z * scale};
        const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, 2).mesh;
        const Verdict verdict = test::verified_by_all(coarse, fine);
        EXPECT_GT(verdict.facts.rounded_midpoints, 0U);
        EXPECT_EQ(codes_of(verdict), "") << scale;
    }
}

TEST(Refinement, BoundsTheDisplacementByRounding) {
    Mesh coarse = test::kuhn(1, 1, 1);
    for (Point& p : coarse.points) p = {p.x / 3 + 1000, p.y / 7, p.z / 11};
    const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, 3).mesh;
    const Verdict verdict = test::verified_by_all(coarse, fine);
    EXPECT_EQ(codes_of(verdict), "");
    EXPECT_GT(verdict.facts.rounded_midpoints, 0U);
    EXPECT_GT(verdict.facts.rounding_bound, 0x1p-45);  // an ulp at 1000 is 2^-43
    EXPECT_LE(verdict.facts.rounding_bound, 4 * 0x1p-44);
}

TEST(Refinement, OfWhichAHalfIsMissingIsNotBlamedOnTheMidpoint) {
    const Mesh coarse = test::one_cell(test::regular_corners);
    Mesh half = reference::refine(coarse, {.all = true}, Scheme::two, 1).mesh;
    ASSERT_EQ(half.cells.size(), 2U);
    half.cells.pop_back();
    const Verdict verdict = test::verified_by_all(coarse, half);
    EXPECT_EQ(codes_of(verdict), "not_tiled");
}

}  // namespace
}  // namespace octetra::verify
