#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/reference/refine.hpp>
#include <octetra/verify/verify.hpp>

#include "mesh/boundary.hpp"
#include "mesh/checks.hpp"
#include "support/meshes.hpp"
#include "verify/hub_meshes.hpp"
#include "verify/mutations.hpp"
#include "verify/together.hpp"
#include "verify/verdicts.hpp"

/// The proof of conformity by the boundary: valid meshes have it, and no others.
namespace octetra::verify {
namespace {

using test::codes_of;

bool is_proven(const Mesh& mesh) {
    Findings findings(100);
    JudgedMesh judged = judged_whole(mesh, Which::fine);
    (void)check_well_formed(judged, findings);
    (void)check_orientation(judged, findings);
    (void)check_faces(judged, findings);
    EXPECT_EQ(codes_of(findings.verdict()), "");
    return boundary_proves_conformity(judged, findings);
}

/// Joins two meshes that have no vertex in common.
Mesh together(const Mesh& a, const Mesh& b) {
    Mesh mesh = a;
    const std::size_t first = a.points.size();
    for (const Point& p : b.points) mesh.points.push_back(p);
    for (CellVertices cell : b.cells) {
        for (VertexIndex& v : cell) v = VertexIndex{first + v.value()};
        mesh.cells.push_back(cell);
    }
    return mesh;
}

Mesh placed(Mesh mesh, double size, double offset) {
    for (Point& p : mesh.points) {
        p = {size * p.x + offset, size * p.y + offset, size * p.z + offset};
    }
    return mesh;
}

/// Without the cells that have a corner in the open cube from `low` to `high`.
Mesh hollow(const Mesh& mesh, double low, double high) {
    Mesh kept = mesh;
    kept.cells = {};
    const auto is_inside = [&](VertexIndex v) {
        const Point& p = mesh.points[v];
        return low < p.x && p.x < high && low < p.y && p.y < high && low < p.z && p.z < high;
    };
    for (const CellVertices& cell : mesh.cells) {
        if (std::none_of(cell.begin(), cell.end(), is_inside)) kept.cells.push_back(cell);
    }
    return kept;
}

const Mesh cube = test::kuhn(4, 4, 4, 0.25);

TEST(Conformity, IsProvenForValidMeshes) {
    EXPECT_TRUE(is_proven(Mesh{}));
    EXPECT_TRUE(is_proven(test::one_cell(test::kuhn_corners)));
    EXPECT_TRUE(is_proven(cube));
    EXPECT_TRUE(is_proven(test::perturbed_kuhn(4, 0.2, 3)));
    EXPECT_TRUE(is_proven(reference::refine(cube, {.all = true}, Scheme::eight, 1).mesh));
    EXPECT_TRUE(is_proven(test::cells_around_edge(1000, 1, 0)));
    EXPECT_TRUE(is_proven(test::cells_at_vertex(1000, -1, 0)));
}

TEST(Conformity, IsProvenForSeveralBodiesAndVoids) {
    EXPECT_TRUE(is_proven(together(cube, placed(cube, 1, 2))));
    const Mesh void_inside = hollow(cube, 0.3, 0.7);
    EXPECT_LT(void_inside.cells.size(), cube.cells.size());
    EXPECT_TRUE(is_proven(void_inside));
    EXPECT_TRUE(is_proven(together(void_inside, placed(cube, 0.125, 0.45))));  // within the void
}

/// The boundaries do not meet, so only the number of cells at a point shows the overlap.
TEST(Conformity, IsNotProvenForABodyWithinAnother) {
    const Mesh mesh = together(cube, placed(cube, 0.4, 0.307));
    EXPECT_FALSE(is_proven(mesh));
    EXPECT_FALSE(test::verified_by_all(mesh).valid());
    const Mesh cell_in_cell = together(test::one_cell(test::kuhn_corners),
                                       placed(test::one_cell(test::kuhn_corners), 0x1p-4, 0));
    EXPECT_FALSE(is_proven(cell_in_cell));  // one corner in common
    Mesh moved = placed(test::one_cell(test::kuhn_corners), 0x1p-4, 0);
    for (Point& p : moved.points) p = {p.x + 0.5, p.y + 0.25, p.z + 0.125};
    const Mesh inside = together(test::one_cell(test::kuhn_corners), moved);
    EXPECT_FALSE(is_proven(inside));
    EXPECT_EQ(codes_of(test::verified_by_all(inside)), "vertex_in_cell");
}

TEST(Conformity, IsNotProvenForBodiesThatTouch) {
    EXPECT_FALSE(is_proven(together(cube, placed(cube, 1, 0.9))));
    Mesh beside = cube;
    for (Point& p : beside.points) p = {p.x + 1, p.y + 0.1, p.z + 0.1};
    EXPECT_FALSE(is_proven(together(cube, beside)));  // in the plane of a face
    for (Point& p : beside.points) p = {p.x, p.y - 0.1, p.z - 0.1};
    EXPECT_FALSE(is_proven(together(cube, beside)));  // vertices coincide
}

/// Two pairs of cells on the two sides of a square, divided along different diagonals: the four
/// faces in its plane have only their four corners.
TEST(Conformity, IsNotProvenForFacesThatMeetInTheirPlane) {
    const Mesh square =
        test::mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}},
                      {{0, 1, 2, 4}, {0, 2, 3, 4}, {1, 0, 3, 5}, {1, 3, 2, 5}});
    EXPECT_FALSE(is_proven(square));
    EXPECT_EQ(codes_of(test::verified_by_all(square)), "boundary_crosses");
    const Mesh triangle =
        test::mesh_of({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {1, 1, 0}, {1, 1, 1}, {1, 1, -1}},
                      {{0, 1, 2, 4}, {1, 0, 3, 5}, {2, 1, 3, 5}, {0, 2, 3, 5}});
    EXPECT_FALSE(is_proven(triangle));
    EXPECT_EQ(codes_of(test::verified_by_all(triangle)), "hanging_vertex");
}

/// No vertex is in the other cell, nor a point beside a face: only edges show the overlap, and they
/// pass faces other than the first of their cell.
TEST(Conformity, IsNotProvenForANeedleThroughACell) {
    const Mesh mesh = test::mesh_of({{0, 0, 4},
                                     {0, 0, 0},
                                     {0, 4, 0},
                                     {4, 0, 0},
                                     {-1, 0.95, 1.05},
                                     {5, 0.9, 1},
                                     {5, 1, 1},
                                     {5, 0.95, 1.1}},
                                    {{0, 1, 2, 3}, {4, 5, 6, 7}});
    EXPECT_FALSE(is_proven(mesh));
    EXPECT_EQ(codes_of(test::verified_by_all(mesh)), "boundary_crosses");
}

/// The cells around an edge turn about it twice, and the boundary around them is one shell.
TEST(Conformity, IsNotProvenForCellsThatOverlapAroundAnEdge) {
    constexpr std::size_t n = 14;
    std::vector<Point> points{{0, 0, -1}, {0, 0, 1}};
    std::vector<std::array<std::size_t, 4>> cells;
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 4 * M_PI * static_cast<double>(i) / n;
        const double radius = 1 + 0.1 * static_cast<double>(i);
        points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
        cells.push_back({0, 1, 2 + i, 2 + (i + 1) % n});
    }
    EXPECT_FALSE(is_proven(test::mesh_of(points, cells)));
    EXPECT_FALSE(test::verified_by_all(test::mesh_of(points, cells)).valid());
}

}  // namespace
}  // namespace octetra::verify
