#include <algorithm>
#include <functional>
#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/edge_order.hpp>
#include <octetra/reference/refine.hpp>
#include <octetra/verify/verify.hpp>

#include "support/meshes.hpp"
#include "verify/broken_case.hpp"
#include "verify/mutations.hpp"
#include "verify/together.hpp"
#include "verify/verdicts.hpp"

/// One broken refinement for each code of verify_refinement(), which must report this code and no
/// other.
namespace octetra::verify {
namespace {

using test::codes_of;

/// Four cubes in a row with tags on all kinds of entities.
Mesh tagged_cubes() {
    Mesh mesh = test::kuhn(4, 1, 1);
    test::list_boundary(mesh);
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        mesh.point_markers.push_back(10 + static_cast<Marker>(v.value()));
        mesh.point_attributes.push_back(mesh.points[v].x * 3);
    }
    mesh.attributes_per_point = 1;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        mesh.regions.push_back(c.value() < 6 ? 1 : 2);
    }
    mesh.edges.push_back({vertex(0), vertex(1)});
    mesh.edge_markers.push_back(7);
    return mesh;
}

/// The cells near one corner, in two levels.
const Request request{
    .selection = {.spheres = {{{0, 0, 0}, 1}}}, .scheme = Scheme::eight, .levels = 2};

struct Refined {
    Mesh coarse = tagged_cubes();
    reference::Refinement fine =
        reference::refine(coarse, request.selection, request.scheme, request.levels);
    VerifyOptions options{.request = request};
    bool claims = true;  ///< maps and request, which claim more than a refinement

    [[nodiscard]] Verdict judge() {
        options.maps = claims ? &fine.maps : nullptr;
        if (!claims) options.request.reset();
        return test::verified_by_all(coarse, fine.mesh, options);
    }
};

struct RefinementCase {
    Code code;
    std::string how;
    std::function<void(Refined&)> breaks;
};
void PrintTo(const RefinementCase& c, std::ostream* out) { *out << name(c.code); }

class BrokenRefinement : public testing::TestWithParam<RefinementCase> {};

TEST_P(BrokenRefinement, IsReportedWithItsCodeAndNoOther) {
    Refined refined;
    ASSERT_EQ(codes_of(refined.judge()), "");
    GetParam().breaks(refined);
    const Verdict verdict = refined.judge();
    EXPECT_EQ(codes_of(verdict), name(GetParam().code));
    EXPECT_FALSE(verdict.violations.empty());
}

/// The first cell of the fine mesh that belongs to the coarse mesh, and the first that does not.
CellIndex kept_cell(const Refined& r) {
    for (CellIndex c{0}; c < r.fine.mesh.cells.end_index(); ++c) {
        const auto in_coarse =
            std::find(r.coarse.cells.begin(), r.coarse.cells.end(), r.fine.mesh.cells[c]);
        if (in_coarse != r.coarse.cells.end()) return c;
    }
    return CellIndex::none();
}

/// Removes everything but points, cells and claims.
void forget_tags(Refined& r) {
    for (Mesh* m : {&r.coarse, &r.fine.mesh}) *m = Mesh{.points = m->points, .cells = m->cells};
    r.claims = false;
}

/// The first midpoint inside the solid.
VertexIndex inner_midpoint(const Refined& r) {
    for (VertexIndex v = r.fine.maps.first_midpoint; v < r.fine.mesh.points.end_index(); ++v) {
        const Point& p = r.fine.mesh.points[v];
        if (p.x > 0 && p.x < 2 && p.y > 0 && p.y < 1 && p.z > 0 && p.z < 1) return v;
    }
    return VertexIndex::none();
}

const std::vector<RefinementCase> broken_refinements{
    {Code::not_a_midpoint, "moved",
     [](Refined& r) {
         Point& p = r.fine.mesh.points[inner_midpoint(r)];
         p = {p.x + 0x1p-10, p.y, p.z};
     }},
    {Code::not_a_midpoint, "by_an_ulp",
     [](Refined& r) { test::shift_by_an_ulp(r.fine.mesh, inner_midpoint(r)); }},
    {Code::lost_vertex, "of_the_coarse_mesh",
     [](Refined& r) { test::shift_by_an_ulp(r.fine.mesh, vertex(11)); }},
    {Code::not_tiled, "dropped_cell",
     [](Refined& r) {
         forget_tags(r);
         test::drop_cell(r.fine.mesh, cell(9));
     }},
    {Code::not_tiled, "unmerged_vertex",
     [](Refined& r) {
         const VertexIndex v = inner_midpoint(r);
         for (CellIndex c{0}; c < r.fine.mesh.cells.end_index(); ++c) {
             for (std::size_t k = 0; k < 4; ++k) {
                 if (r.fine.mesh.cells[c][k] != v) continue;
                 return test::unmerge_vertex(r.fine.mesh, c, k);
             }
         }
     }},
    {Code::cell_of_no_parent, "beside_the_others",
     [](Refined& r) {
         Mesh& m = r.fine.mesh;
         const std::size_t first = m.points.size();
         for (const Point& p : {Point{8, 8, 8}, Point{9, 8, 8}, Point{8, 9, 8}, Point{8, 8, 9}}) {
             (void)test::append_vertex(m, p);
         }
         test::append_cell(
             m, {vertex(first), vertex(first + 1), vertex(first + 2), vertex(first + 3)}, cell(0));
     }},
    {Code::hanging_vertex, "split_without_its_neighbours",
     [](Refined& r) {
         forget_tags(r);
         test::bisect_alone(r.fine.mesh, kept_cell(r), 0);
     }},
    {Code::hanging_vertex, "merged",
     [](Refined& r) {
         forget_tags(r);
         const RefinementMaps& maps = r.fine.maps;
         for (std::size_t i = maps.midpoint_to_edge.size(); i-- > 0;) {
             const VertexIndex m{maps.first_midpoint.value() + i};
             const auto [a, b] = maps.midpoint_to_edge[i];
             if (test::merge_two_cells(r.fine.mesh, m, a, b)) return;
         }
     }},
    {Code::open_face, "split_without_its_neighbours_and_judged_fast",
     [](Refined& r) {
         r.options.fast = true;
         forget_tags(r);
         test::bisect_alone(r.fine.mesh, kept_cell(r), 0);
     }},
    {Code::unused_vertex, "far_away",
     [](Refined& r) {
         r.claims = false;
         (void)test::append_vertex(r.fine.mesh, {9, 9, 9});
     }},
    {Code::face_angle_too_small, "bisected_towards_an_end",
     [](Refined& r) {
         r.coarse = test::one_cell(test::regular_corners);
         r.fine.mesh = r.coarse;
         r.claims = false;
         for (const std::size_t end : {1U, 4U, 5U}) {
             test::bisect_edge(r.fine.mesh, vertex(0), vertex(end));
         }
     }},
    {Code::wrong_pattern, "shortest_edges_first",
     [](Refined& r) {
         r.coarse = test::one_cell(test::regular_corners);
         r.fine = reference::refine(r.coarse, {.all = true}, Scheme::eight, 0);
         r.options.request = Request{.selection = {.all = true}};
         std::vector<EdgeVertices> edges;
         for (const auto& [i, j] : cell_edges) edges.push_back({vertex(i), vertex(j)});
         std::sort(edges.begin(), edges.end(), [&](const auto& e, const auto& f) {
             const auto& p = r.coarse.points;
             return longer({p[f[0]], p[f[1]]}, {p[e[0]], p[e[1]]});
         });
         for (const auto& [a, b] : edges) {
             test::bisect_edge(r.fine.mesh, a, b);
             r.fine.maps.midpoint_to_edge.push_back({a, b});
         }
         r.fine.maps.cell_to_parent.assign(r.fine.mesh.cells.size(), cell(0));
     }},
    {Code::inverted_cell, "flipped", [](Refined& r) { test::flip_cell(r.fine.mesh, cell(7)); }},
    {Code::wrong_parent, "in_the_map",
     [](Refined& r) { r.fine.maps.cell_to_parent[cell(2)] = cell(11); }},
    {Code::wrong_parent, "map_of_another_length",
     [](Refined& r) { r.fine.maps.cell_to_parent.pop_back(); }},
    {Code::wrong_midpoint_edge, "in_the_map",
     [](Refined& r) {
         r.fine.maps.midpoint_to_edge[3] = {vertex(0), vertex(11)};
     }},
    {Code::wrong_midpoint_edge, "out_of_range",
     [](Refined& r) { r.fine.maps.midpoint_to_edge[3][0] = VertexIndex::none(); }},
    {Code::wrong_region, "of_one_cell", [](Refined& r) { r.fine.mesh.regions[cell(5)] = 9; }},
    {Code::wrong_region, "all_lost", [](Refined& r) { r.fine.mesh.regions.clear(); }},
    {Code::wrong_facet_marker, "all_lost", [](Refined& r) { r.fine.mesh.facet_markers.clear(); }},
    {Code::missing_facet, "all_lost",
     [](Refined& r) {
         r.fine.mesh.facets.clear();
         r.fine.mesh.facet_markers.clear();
     }},
    {Code::missing_edge, "all_lost",
     [](Refined& r) {
         r.fine.mesh.edges.clear();
         r.fine.mesh.edge_markers.clear();
     }},
    {Code::wrong_vertex_marker, "all_lost", [](Refined& r) { r.fine.mesh.point_markers.clear(); }},
    {Code::wrong_attribute, "all_lost",
     [](Refined& r) {
         r.fine.mesh.attributes_per_point = 0;
         r.fine.mesh.point_attributes.clear();
     }},
    {Code::wrong_facet_marker, "of_one_facet",
     [](Refined& r) { r.fine.mesh.facet_markers[FacetIndex{4}] = 99; }},
    {Code::missing_facet, "of_the_boundary",
     [](Refined& r) {
         test::erase(r.fine.mesh.facets, FacetIndex{4});
         test::erase(r.fine.mesh.facet_markers, FacetIndex{4});
     }},
    {Code::extra_facet, "twice",
     [](Refined& r) {
         r.fine.mesh.facets.push_back(r.fine.mesh.facets[FacetIndex{4}]);
         r.fine.mesh.facet_markers.push_back(1);
     }},
    {Code::wrong_edge_marker, "of_one_piece",
     [](Refined& r) { r.fine.mesh.edge_markers[EdgeIndex{1}] = 8; }},
    {Code::missing_edge, "one_piece",
     [](Refined& r) {
         test::erase(r.fine.mesh.edges, EdgeIndex{1});
         test::erase(r.fine.mesh.edge_markers, EdgeIndex{1});
     }},
    {Code::extra_edge, "elsewhere",
     [](Refined& r) {
         const CellVertices& c = r.fine.mesh.cells.back();
         r.fine.mesh.edges.push_back({c[0], c[1]});
         r.fine.mesh.edge_markers.push_back(7);
     }},
    {Code::wrong_vertex_marker, "of_the_coarse_mesh",
     [](Refined& r) { r.fine.mesh.point_markers[vertex(3)] = 0; }},
    {Code::wrong_vertex_marker, "of_a_midpoint",
     [](Refined& r) { r.fine.mesh.point_markers.back() += 1; }},
    {Code::wrong_attribute, "of_a_midpoint",
     [](Refined& r) { r.fine.mesh.point_attributes.back() += 0x1p-40; }},
    {Code::dihedral_too_small, "for_the_limit",
     [](Refined& r) { r.options.min_dihedral = 45.0000000001; }},
    {Code::missing_bisection, "larger_sphere",
     [](Refined& r) { r.options.request->selection.spheres[0].radius = 1.4; }},
    {Code::missing_bisection, "one_level_more", [](Refined& r) { ++r.options.request->levels; }},
    {Code::needless_bisection, "smaller_sphere",
     [](Refined& r) { r.options.request->selection.spheres[0].radius = 0.9; }},
    {Code::needless_bisection, "one_level_less", [](Refined& r) { --r.options.request->levels; }},
};
TEST(Facets, ThatConflictInTheCoarseMeshEndTheJudgementThere) {
    Refined r;
    r.coarse.facets.push_back(r.coarse.facets[FacetIndex{0}]);
    r.coarse.facet_markers.push_back(99);
    const Verdict verdict = r.judge();
    EXPECT_EQ(codes_of(verdict), "conflicting_markers");
    EXPECT_EQ(verdict.violations[0].entities[0].mesh, Which::coarse);
}

/// The status of a check that was made.
Status status_of(const Verdict& verdict, std::string_view check) {
    const auto at = std::find_if(verdict.checks.begin(), verdict.checks.end(),
                                 [&](const Check& c) { return c.name == check; });
    return at == verdict.checks.end() ? Status::failed : at->status;
}

TEST(Tags, ThatAreZeroThroughoutMayBeLeftOut) {
    Refined r;
    for (Mesh* m : {&r.coarse, &r.fine.mesh}) {
        std::fill(m->regions.begin(), m->regions.end(), 0);
        std::fill(m->facet_markers.begin(), m->facet_markers.end(), 0);
        std::fill(m->edge_markers.begin(), m->edge_markers.end(), 0);
        std::fill(m->point_markers.begin(), m->point_markers.end(), 0);
    }
    r.fine.mesh.regions.clear();
    r.fine.mesh.facet_markers.clear();
    r.fine.mesh.edge_markers.clear();
    r.fine.mesh.point_markers.clear();
    const Verdict verdict = r.judge();
    EXPECT_EQ(codes_of(verdict), "");
    EXPECT_EQ(status_of(verdict, "region tags"), Status::passed);
    EXPECT_EQ(status_of(verdict, "vertex markers"), Status::passed);
}

TEST(Tags, ThatTheCoarseMeshDoesNotHaveAreNotChecked) {
    Refined r;
    r.coarse = Mesh{.points = r.coarse.points, .cells = r.coarse.cells};
    const Verdict verdict = r.judge();
    EXPECT_EQ(codes_of(verdict), "");
    for (const std::string_view name :
         {"region tags", "facets", "edges", "vertex markers", "attributes"}) {
        EXPECT_EQ(status_of(verdict, name), Status::skipped) << name;
    }
}

TEST(Tags, AttributesMayBeLostInAFormatThatCannotStoreThem) {
    Refined r;
    r.fine.mesh.attributes_per_point = 0;
    r.fine.mesh.point_attributes.clear();
    r.options.attributes_lost = "no place";
    const Verdict verdict = r.judge();
    EXPECT_EQ(codes_of(verdict), "");
    EXPECT_EQ(status_of(verdict, "attributes"), Status::skipped);
}

TEST(Tags, VertexMarkersMayBeLostInAFormatThatCannotStoreThem) {
    Refined r;
    r.coarse.point_markers.assign(r.coarse.points.size(), 7);
    r.fine.mesh.point_markers.clear();
    EXPECT_EQ(codes_of(r.judge()), "wrong_vertex_marker");
    r.options.vertex_markers_lost = "no place";
    const Verdict verdict = r.judge();
    EXPECT_EQ(codes_of(verdict), "");
    EXPECT_EQ(status_of(verdict, "vertex markers"), Status::skipped);
}

INSTANTIATE_TEST_SUITE_P(, BrokenRefinement, testing::ValuesIn(broken_refinements),
                         name_of<RefinementCase>);

}  // namespace
}  // namespace octetra::verify
