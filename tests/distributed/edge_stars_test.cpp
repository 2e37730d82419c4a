#include "edge_stars.hpp"

#include <set>

#include <gtest/gtest.h>

#include "support/meshes.hpp"
#include "support/refinement.hpp"

namespace octetra::distributed {
namespace {

/// Cells round an edge whose ends are vertices 0 and 1, hubs of `count` edges each.
Mesh fan(std::size_t count) {
    std::vector<Point> points{{0, 0, 0}, {0, 0, 1}};
    std::vector<std::array<std::size_t, 4>> cells;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 6 * static_cast<double>(i) / static_cast<double>(count);
        points.push_back({std::cos(angle), std::sin(angle), 0.5});
        if (i > 0) cells.push_back({0, 1, i + 1, i + 2});
    }
    return test::mesh_of(points, cells);
}

void expect_every_edge_once(const Mesh& mesh) {
    const EdgeStars stars(mesh.points.size(), mesh.cells);
    std::set<EdgeVertices> edges;
    for (VertexIndex low{0}; low < mesh.points.end_index(); ++low) {
        for (EdgeIndex e = stars.begin_of(low); e < stars.end_of(low); ++e) {
            ASSERT_TRUE(edges.insert({low, stars.high_end(e)}).second) << "listed twice";
            ASSERT_EQ(stars.find(low, stars.high_end(e)), e);
            ASSERT_EQ(stars.find(stars.high_end(e), low), e);
        }
    }
    std::set<EdgeVertices> expected;
    for (const auto& [edge, cells] : test::cells_at_edges(mesh)) expected.insert(edge);
    EXPECT_EQ(edges, expected);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (std::size_t e = 0; e < 6; ++e) {
            ASSERT_EQ(stars.edges_of(c)[e],
                      stars.find(mesh.cells[c][cell_edges[e][0]], mesh.cells[c][cell_edges[e][1]]));
        }
    }
    EXPECT_TRUE(stars.find(VertexIndex{0}, VertexIndex{0}).is_none());
}

/// An edge that there is not may be one of a neighbour's.
TEST(EdgeStars, FindNothingBetweenVerticesWithoutAnEdge) {
    const Mesh mesh = test::kuhn(3, 2, 4);
    const EdgeStars stars(mesh.points.size(), mesh.cells);
    const auto edges = test::cells_at_edges(mesh);
    for (VertexIndex a{0}; a < mesh.points.end_index(); ++a) {
        for (VertexIndex b{0}; b < a; ++b) {
            EXPECT_EQ(stars.find(a, b).is_none(), !edges.contains({b, a}));
        }
    }
}

TEST(EdgeStars, HaveEveryEdgeOfTheCellsOnce) {
    expect_every_edge_once(test::kuhn(3, 2, 4));
    expect_every_edge_once(test::one_cell(test::cube_corner));
}

/// Sixteen edges of a vertex are kept together; beyond 64 they are kept in another way.
TEST(EdgeStars, HaveEveryEdgeOnceHoweverManyAVertexHas) {
    for (std::size_t count = 2; count < 70; ++count) expect_every_edge_once(fan(count));
}

TEST(EdgeStars, HaveEveryEdgeOnceAtAHubOfThousands) { expect_every_edge_once(fan(5000)); }

}  // namespace
}  // namespace octetra::distributed
