#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <octetra/verify/compare.hpp>

#include "support/meshes.hpp"
#include "verify/mutations.hpp"

namespace octetra::verify {
namespace {

Mesh tagged() {
    Mesh mesh = test::kuhn(2, 1, 1);
    test::list_boundary(mesh);
    mesh.regions.assign(mesh.cells.size(), 3);
    mesh.point_markers.assign(mesh.points.size(), 0);
    mesh.edges.push_back({VertexIndex{0}, VertexIndex{1}});
    mesh.edge_markers.push_back(5);
    return mesh;
}

/// Reverses vertices and cells, and rotates corners without changing the orientation.
Mesh renumbered(const Mesh& mesh) {
    Mesh result = mesh;
    const auto last = static_cast<std::uint32_t>(mesh.points.size() - 1);
    std::reverse(result.points.begin(), result.points.end());
    const auto renumber = [&](auto& list) {
        for (auto& entity : list) {
            for (VertexIndex& v : entity) v = VertexIndex{last - v.value()};
        }
        std::reverse(list.begin(), list.end());
    };
    renumber(result.cells);
    renumber(result.facets);
    renumber(result.edges);
    for (CellVertices& cell : result.cells) {
        std::swap(cell[0], cell[1]);
        std::swap(cell[2], cell[3]);
    }
    std::reverse(result.regions.begin(), result.regions.end());
    std::reverse(result.facet_markers.begin(), result.facet_markers.end());
    std::reverse(result.point_markers.begin(), result.point_markers.end());
    return result;
}

TEST(Compare, FindsAMeshIdenticalToItself) {
    EXPECT_EQ(compare(tagged(), tagged()).likeness, Likeness::identical);
    EXPECT_EQ(compare({}, {}).likeness, Likeness::identical);
}

TEST(Compare, ReportsIfOnlyTheIndexBaseDiffers) {
    const Mesh mesh = test::kuhn(1, 1, 1);
    Mesh other = mesh;
    other.index_base = 1;
    EXPECT_EQ(compare(mesh, other).likeness, Likeness::up_to_numbering);
    EXPECT_TRUE(compare(mesh, other).index_base_differs);
    EXPECT_FALSE(compare(mesh, mesh).index_base_differs);
    std::swap(other.cells[CellIndex{0}], other.cells[CellIndex{1}]);
    EXPECT_EQ(compare(mesh, other).likeness, Likeness::up_to_numbering);
    EXPECT_FALSE(compare(mesh, other).index_base_differs);
}

TEST(Compare, LooksAtNoNamesOfGroups) {
    Mesh named = tagged();
    named.group_names = {{3, 1, "rock"}};
    EXPECT_EQ(compare(named, tagged()).likeness, Likeness::identical);
    named.regions.back() += 1;
    EXPECT_EQ(compare(named, tagged()).likeness, Likeness::different);
}

TEST(Compare, SeesThroughAnotherNumbering) {
    const Comparison comparison = compare(tagged(), renumbered(tagged()));
    EXPECT_EQ(comparison.likeness, Likeness::up_to_numbering);
    EXPECT_EQ(comparison.difference_count, 0U);
    Mesh from_one = tagged();
    from_one.index_base = 1;
    EXPECT_EQ(compare(tagged(), from_one).likeness, Likeness::up_to_numbering);
}

struct Change {
    std::string kind;
    std::function<void(Mesh&)> make;
};

TEST(Compare, NamesDifferencesByCoordinates) {
    const std::vector<Change> changes{
        {"vertex", [](Mesh& m) { test::shift_by_an_ulp(m, VertexIndex{4}); }},
        {"vertex", [](Mesh& m) { m.point_markers[VertexIndex{4}] = 1; }},
        {"vertex",
         [](Mesh& m) {
             (void)test::append_vertex(m, {5, 5, 5});
         }},
        {"cell", [](Mesh& m) { m.regions[CellIndex{2}] = 4; }},
        {"cell", [](Mesh& m) { test::flip_cell(m, CellIndex{2}); }},
        {"cell", [](Mesh& m) { test::drop_cell(m, CellIndex{2}); }},
        {"cell", [](Mesh& m) { test::duplicate_cell(m, CellIndex{2}); }},
        {"facet", [](Mesh& m) { m.facet_markers[FacetIndex{3}] = -1; }},
        {"facet", [](Mesh& m) { m.facets[FacetIndex{3}] = m.facets[FacetIndex{4}]; }},
        {"edge", [](Mesh& m) { m.edge_markers[EdgeIndex{0}] = 6; }},
        {"edge", [](Mesh& m) { m.edges[EdgeIndex{0}][1] = VertexIndex{4}; }},
    };
    for (const Change& change : changes) {
        Mesh changed = renumbered(tagged());
        change.make(changed);
        const Comparison comparison = compare(tagged(), changed);
        EXPECT_EQ(comparison.likeness, Likeness::different);
        ASSERT_FALSE(comparison.differences.empty()) << change.kind;
        EXPECT_EQ(comparison.differences.front().kind, change.kind);
        EXPECT_NE(comparison.differences.front().in_a, comparison.differences.front().in_b);
    }
}

TEST(Compare, CountsAllDifferencesAndDescribesSome) {
    Mesh other = tagged();
    other.regions.assign(other.cells.size(), 8);
    const Comparison comparison = compare(tagged(), other, 5);
    EXPECT_EQ(comparison.difference_count, other.cells.size());
    ASSERT_EQ(comparison.differences.size(), 5U);
    EXPECT_EQ(comparison.differences[0].in_a, "region 3");
    EXPECT_EQ(comparison.differences[0].in_b, "region 8");
    EXPECT_EQ(comparison.differences[0].corners.size(), 4U);
}

TEST(Compare, FindsZerosOfAnotherSignEqualAndNotIdentical) {
    Mesh mesh = tagged();
    mesh.attributes_per_point = 1;
    mesh.point_attributes.assign(mesh.points.size(), 0);
    ASSERT_EQ(mesh.points[VertexIndex{0}].x, 0);
    Mesh of_points = mesh;
    of_points.points[VertexIndex{0}].x = -0.0;
    Mesh of_attributes = mesh;
    of_attributes.point_attributes[2] = -0.0;
    for (const Mesh& other : {of_points, of_attributes}) {
        EXPECT_EQ(compare(mesh, other).likeness, Likeness::up_to_numbering);
        EXPECT_TRUE(compare(mesh, other).signs_of_zeros_differ);
        EXPECT_EQ(compare(other, other).likeness, Likeness::identical);
        Mesh from_one = other;
        from_one.index_base = 1;
        EXPECT_EQ(compare(mesh, from_one).likeness, Likeness::up_to_numbering);
        EXPECT_TRUE(compare(mesh, from_one).index_base_differs);
        EXPECT_TRUE(compare(mesh, from_one).signs_of_zeros_differ);
    }
    EXPECT_FALSE(compare(mesh, mesh).signs_of_zeros_differ);
}

TEST(Compare, SaysWhereOnlyTagsThatAreAllZeroDiffer) {
    const Mesh mesh = tagged();  // with vertex markers that are all 0
    Mesh other = mesh;
    other.point_markers = {};
    for (const Comparison& found : {compare(mesh, other), compare(other, mesh)}) {
        EXPECT_EQ(found.likeness, Likeness::up_to_numbering);
        EXPECT_TRUE(found.zero_tags_differ);
        EXPECT_FALSE(found.index_base_differs);
        EXPECT_FALSE(found.signs_of_zeros_differ);
    }
    other.regions = {};
    EXPECT_EQ(compare(mesh, other).likeness, Likeness::different);
    EXPECT_FALSE(compare(mesh, other).zero_tags_differ);
    other = mesh;
    other.point_markers = {};
    other.index_base = 1;
    EXPECT_TRUE(compare(mesh, other).index_base_differs);
    EXPECT_TRUE(compare(mesh, other).zero_tags_differ);
    EXPECT_FALSE(compare(mesh, mesh).zero_tags_differ);
}

TEST(Compare, FindsAttributesThatAreNoNumbersEqual) {
    Mesh mesh = tagged();
    mesh.attributes_per_point = 1;
    mesh.point_attributes.assign(mesh.points.size(), std::nan(""));
    EXPECT_EQ(compare(mesh, mesh).likeness, Likeness::identical);
    Mesh moved = mesh;
    std::swap(moved.cells[CellIndex{0}], moved.cells[CellIndex{1}]);
    EXPECT_EQ(compare(mesh, moved).likeness, Likeness::up_to_numbering);
    moved.point_attributes[2] = 1;
    EXPECT_EQ(compare(mesh, moved).likeness, Likeness::different);
}

/// Two cells with three coincident corners: at one face, or at a crack with separate vertices.
/// The mesh with each coordinate moved by at most `distance`, in another direction at each vertex.
Mesh shaken(Mesh mesh, double distance) {
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        const double angle = v.value();
        mesh.points[v].x += distance * std::sin(angle);
        mesh.points[v].y += distance * std::cos(angle);
    }
    return mesh;
}

TEST(Compare, WithinATolerance_FindsMovedVerticesInAnotherNumbering) {
    const Mesh mesh = tagged();
    const Mesh other = shaken(renumbered(mesh), 1e-9);
    EXPECT_EQ(compare_within(1e-10, mesh, other).likeness, Likeness::different);
    const Comparison found = compare_within(2e-9, mesh, other);
    EXPECT_EQ(found.likeness, Likeness::up_to_numbering);
    EXPECT_NEAR(found.greatest_distance, 1e-9, 1e-15);
    EXPECT_EQ(compare_within(0, mesh, mesh).likeness, Likeness::identical);
    EXPECT_EQ(compare_within(0, mesh, mesh).greatest_distance, 0);
}

TEST(Compare, WithinATolerance_TakesTheNearestOfSeveralVertices) {
    const Mesh mesh = test::kuhn(2, 2, 2);  // edges from 0.5 on
    const Comparison found = compare_within(10, mesh, shaken(mesh, 0.2));
    EXPECT_EQ(found.likeness, Likeness::identical);
    EXPECT_NEAR(found.greatest_distance, 0.2, 1e-12);
}

TEST(Compare, WithinATolerance_DoesNotMergeVertices) {
    const Mesh mesh = test::kuhn(1, 1, 1);
    Mesh other = mesh;
    other.points[VertexIndex{0}] = other.points[VertexIndex{1}];
    EXPECT_EQ(compare_within(10, mesh, other).likeness, Likeness::different);
    EXPECT_EQ(compare_within(10, other, mesh).likeness, Likeness::different);
}

TEST(Compare, WithinATolerance_ComparesTagsAndAttributesExactly) {
    const Mesh mesh = tagged();
    Mesh other = shaken(mesh, 1e-9);
    other.facet_markers.back() += 1;
    const Comparison found = compare_within(1e-8, mesh, other);
    ASSERT_EQ(found.differences.size(), 1U);
    EXPECT_EQ(found.differences.front().kind, "facet");
}

TEST(Compare, DistinguishesACrackFromAFace) {
    const std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                    {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    const Mesh crack = test::mesh_of(points, {{0, 1, 2, 3}, {4, 5, 6, 7}});
    const Mesh half_closed = test::mesh_of(points, {{0, 1, 2, 3}, {0, 5, 6, 7}});
    const Mesh other_names = test::mesh_of(points, {{4, 1, 6, 3}, {0, 5, 2, 7}});
    EXPECT_EQ(compare(crack, half_closed).likeness, Likeness::different);
    EXPECT_EQ(compare(crack, other_names).likeness, Likeness::up_to_numbering);
}

}  // namespace
}  // namespace octetra::verify
