#include <algorithm>
#include <functional>
#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/edge_order.hpp>
#include <octetra/verify/verify.hpp>

#include "support/meshes.hpp"
#include "verify/broken_case.hpp"
#include "verify/mutations.hpp"
#include "verify/together.hpp"
#include "verify/verdicts.hpp"

/// One broken mesh for each code of verify_mesh(), which must report this code and no other.
namespace octetra::verify {
namespace {

using test::codes_of;

/// Two cubes of six cells each.
Mesh two_cubes() { return test::kuhn(2, 1, 1); }

struct MeshCase {
    Code code;
    std::string how;
    std::function<Mesh()> make;
};
void PrintTo(const MeshCase& c, std::ostream* out) { *out << name(c.code); }

/// A case that modifies two_cubes().
MeshCase of_two_cubes(Code code, const std::string& how, const std::function<void(Mesh&)>& breaks) {
    return {code, how, [breaks] {
                Mesh mesh = two_cubes();
                breaks(mesh);
                return mesh;
            }};
}

class BrokenMesh : public testing::TestWithParam<MeshCase> {};

TEST_P(BrokenMesh, IsReportedWithItsCodeAndNoOther) {
    ASSERT_EQ(codes_of(verify_mesh(two_cubes())), "");
    const Mesh mesh = GetParam().make();
    // Lists of unequal length cannot be distributed.
    const bool in_one_memory = GetParam().code == Code::list_length;
    const Verdict verdict = in_one_memory ? verify_mesh(mesh) : test::verified_by_all(mesh);
    EXPECT_EQ(codes_of(verdict), name(GetParam().code));
    EXPECT_FALSE(verdict.violations.empty());
    EXPECT_FALSE(verdict.valid());
}

const std::vector<MeshCase> broken_meshes{
    of_two_cubes(Code::vertex_out_of_range, "in_a_cell",
                 [](Mesh& m) { m.cells[cell(3)][1] = vertex(99); }),
    of_two_cubes(Code::vertex_out_of_range, "in_a_facet",
                 [](Mesh& m) {
                     m.facets.push_back({vertex(0), vertex(1), VertexIndex::none()});
                 }),
    of_two_cubes(Code::vertex_out_of_range, "in_an_edge",
                 [](Mesh& m) {
                     m.edges.push_back({vertex(0), vertex(12)});
                 }),
    of_two_cubes(Code::list_length, "of_region_tags", [](Mesh& m) { m.regions.assign(3, 1); }),
    of_two_cubes(Code::list_length, "of_attributes", [](Mesh& m) { m.attributes_per_point = 2; }),
    of_two_cubes(Code::not_finite, "coordinate",
                 [](Mesh& m) { m.points[vertex(2)].y = std::nan(""); }),
    of_two_cubes(Code::repeated_vertex, "in_a_cell",
                 [](Mesh& m) {
                     test::append_cell(m, {vertex(0), vertex(1), vertex(4), vertex(4)}, cell(0));
                 }),
    of_two_cubes(Code::repeated_vertex, "in_a_facet",
                 [](Mesh& m) {
                     m.facets.push_back({vertex(0), vertex(1), vertex(0)});
                 }),
    of_two_cubes(Code::repeated_cell, "in_other_order",
                 [](Mesh& m) {
                     const CellVertices c = m.cells[cell(5)];
                     test::append_cell(m, {c[2], c[0], c[3], c[1]}, cell(5));
                 }),
    of_two_cubes(Code::coincident_vertices, "unmerged",
                 [](Mesh& m) { test::unmerge_vertex(m, cell(2), 0); }),
    of_two_cubes(Code::stray_facet, "across",
                 [](Mesh& m) {
                     m.facets.push_back({vertex(0), vertex(1), vertex(11)});
                 }),
    of_two_cubes(Code::stray_edge, "across",
                 [](Mesh& m) {
                     m.edges.push_back({vertex(0), vertex(11)});
                 }),
    of_two_cubes(Code::conflicting_markers, "of_a_facet",
                 [](Mesh& m) {
                     m.facets = {{vertex(0), vertex(1), vertex(4)},
                                 {vertex(1), vertex(2), vertex(5)},
                                 {vertex(4), vertex(0), vertex(1)}};
                     m.facet_markers = {3, 3, 5};
                 }),
    of_two_cubes(Code::conflicting_markers, "of_an_edge",
                 [](Mesh& m) {
                     m.edges = {{vertex(0), vertex(1)}, {vertex(1), vertex(0)}};
                     m.edge_markers = {3, 0};
                 }),
    of_two_cubes(Code::inverted_cell, "flipped", [](Mesh& m) { test::flip_cell(m, cell(4)); }),
    of_two_cubes(Code::inverted_cell, "vertex_beyond",
                 [](Mesh& m) {
                     m.points[vertex(0)] = {1.5, 1.5, 1.5};
                 }),
    of_two_cubes(Code::flat_cell, "laid_on_a_side",
                 [](Mesh& m) {
                     test::append_cell(m, {vertex(1), vertex(2), vertex(4), vertex(5)}, cell(0));
                 }),
    {Code::face_of_many_cells, "three",
     [] {
         return test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {2, 2, 1}},
                              {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 2, 5}});
     }},
    {Code::cells_on_one_side, "both_above",
     [] {
         return test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 1}},
                              {{0, 1, 2, 3}, {0, 1, 2, 4}});
     }},
    of_two_cubes(Code::hanging_vertex, "on_an_edge",
                 [](Mesh& m) { test::bisect_alone(m, cell(0), 0); }),
    {Code::hanging_vertex, "on_a_face",
     [] {  // two cells with a vertex of the second inside a face of the first
         return test::mesh_of({{0, 0, 0},
                               {4, 0, 0},
                               {0, 4, 0},
                               {0, 0, 4},
                               {1, 1, 0},
                               {2, 1, -1},
                               {1, 2, -1},
                               {1, 1, -2}},
                              {{0, 1, 2, 3}, {4, 5, 6, 7}});
     }},
    {Code::vertex_in_cell, "of_another_cell",
     [] {
         return test::mesh_of({{0, 0, 0},
                               {8, 0, 0},
                               {0, 8, 0},
                               {0, 0, 8},
                               {1, 1, 1},
                               {1, 2, 1},
                               {2, 1, 1},
                               {1, 1, 2}},
                              {{0, 1, 2, 3}, {4, 5, 6, 7}});
     }},
    {Code::boundary_crosses, "thin_cell_through_another",
     [] {
         return test::mesh_of({{0, 0, 0},
                               {8, 0, 0},
                               {0, 8, 0},
                               {0, 0, 8},
                               {1, 1, -9},
                               {1, 2, -9},
                               {2, 1, -9},
                               {1, 1, 90}},
                              {{0, 1, 2, 3}, {4, 5, 6, 7}});
     }},
    {Code::boundary_crosses, "diagonals_that_differ",  // of the square between two pyramids
     [] {
         return test::mesh_of({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 1}, {1, 1, -1}},
                              {{0, 1, 2, 4}, {0, 2, 3, 4}, {0, 1, 3, 5}, {1, 2, 3, 5}});
     }},
    {Code::boundary_crosses, "cell_among_others_by_their_vertices",
     [] {  // every second corner of the middle cube
         Mesh mesh = test::kuhn(3, 3, 3);
         const auto at = [](std::size_t x, std::size_t y, std::size_t z) {
             return vertex(x + 4 * y + 16 * z);
         };
         test::append_cell(mesh, {at(1, 1, 1), at(2, 2, 1), at(2, 1, 2), at(1, 2, 2)}, cell(0));
         const Verdict verdict = verify_mesh(mesh);
         if (verdict.count(Code::inverted_cell) > 0) {
             test::flip_cell(mesh, CellIndex{mesh.cells.size() - 1});
         }
         return mesh;
     }},
    {Code::boundary_crosses, "edges_through_inner_faces_alone",
     [] {
         // A cell with one on each face, and a sixth between the tips of these four. Its edges pass
         // through the inner faces; no edge of the others meets its faces.
         std::vector<Point> points;
         for (const Point& p : test::regular_corners) points.push_back({3 * p.x, 3 * p.y, 3 * p.z});
         for (const Point& p : test::regular_corners) {
             points.push_back({-2 * p.x, -2 * p.y, -2 * p.z});
         }
         return test::mesh_of(
             points,
             {{0, 1, 2, 3}, {4, 1, 2, 3}, {0, 5, 2, 3}, {0, 1, 6, 3}, {0, 1, 2, 7}, {4, 5, 6, 7}});
     }},
    {Code::boundary_crosses, "edges_that_cross_in_a_plane",
     [] {
         return test::mesh_of({{0, 0, 0},
                               {4, 0, 0},
                               {2, -1, 3},
                               {2, 1, 3},
                               {2, -1, 0},
                               {2, 1, 0},
                               {1, 0, -3},
                               {3, 0, -3}},
                              {{0, 1, 2, 3}, {4, 5, 6, 7}});
     }},
};
INSTANTIATE_TEST_SUITE_P(, BrokenMesh, testing::ValuesIn(broken_meshes), name_of<MeshCase>);

/// Also inside a cell, and at the coordinates of another vertex.
TEST(Vertices, OfNoCellAreNotedAndKeepNoCheckFromRunning) {
    Mesh mesh = test::kuhn(2, 1, 1);
    const auto point = [&](std::size_t i) { return mesh.points[mesh.cells[cell(0)][i]]; };
    mesh.points.push_back({9, 9, 9});
    mesh.points.push_back(midpoint(midpoint(point(0), point(1)), midpoint(point(2), point(3))));
    mesh.points.push_back(mesh.points[vertex(0)]);
    const Verdict verdict = test::verified_by_all(mesh);
    EXPECT_TRUE(verdict.valid());
    EXPECT_EQ(verdict.facts.unused_vertices, 3U);
    EXPECT_EQ(test::check_named(verdict, "vertices").note, "3 vertices belong to no cell");
    EXPECT_EQ(test::check_named(verdict, "boundary crossings").status, Status::passed);
}

TEST(Facets, MayBeListedTwiceWithOneMarker) {
    Mesh mesh = two_cubes();
    mesh.facets = {{vertex(0), vertex(1), vertex(4)}, {vertex(4), vertex(0), vertex(1)}};
    EXPECT_EQ(codes_of(verify_mesh(mesh)), "");
    mesh.facet_markers = {3, 3};
    EXPECT_EQ(codes_of(verify_mesh(mesh)), "");
}

}  // namespace
}  // namespace octetra::verify
