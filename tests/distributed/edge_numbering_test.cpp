#include "level/full_sweep/edge_numbering.hpp"

#include <set>

#include <gtest/gtest.h>

#include "support/meshes.hpp"
#include "support/refinement.hpp"

namespace octetra::distributed {
namespace {

/// Cells round the edge of vertices 0 and 1, which have about `count` edges each.
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
    const EdgeNumbering stars(mesh.points.size(), mesh.cells);
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

/// A neighbour may have an edge that is not in this part.
TEST(EdgeNumbering, FindNothingBetweenVerticesWithoutAnEdge) {
    const Mesh mesh = test::kuhn(3, 2, 4);
    const EdgeNumbering stars(mesh.points.size(), mesh.cells);
    const auto edges = test::cells_at_edges(mesh);
    for (VertexIndex a{0}; a < mesh.points.end_index(); ++a) {
        for (VertexIndex b{0}; b < a; ++b) {
            EXPECT_EQ(stars.find(a, b).is_none(), !edges.contains({b, a}));
        }
    }
}

TEST(EdgeNumbering, HaveEveryEdgeOfTheCellsOnce) {
    expect_every_edge_once(test::kuhn(3, 2, 4));
    expect_every_edge_once(test::one_cell(test::cube_corner));
}

/// Up to sixteen edges of a vertex are stored together; beyond 64 the storage changes.
TEST(EdgeNumbering, HaveEveryEdgeOnceForAnyDegreeOfAVertex) {
    for (std::size_t count = 2; count < 70; ++count) expect_every_edge_once(fan(count));
}

TEST(EdgeNumbering, HaveEveryEdgeOnceAtAHubOfThousands) { expect_every_edge_once(fan(5000)); }

/// In a numbering of some cells, all other edges share one further number.
TEST(EdgeNumbering, OfSomeCellsLeaveOneNumberForAllOtherEdges) {
    const Mesh mesh = test::kuhn(3, 2, 4);
    std::vector<CellIndex> some;
    for (std::size_t c = 3; c < mesh.cells.size(); c += 7) some.emplace_back(c);
    const EdgeNumbering stars(mesh.points.size(), mesh.cells, some);

    ASSERT_EQ(stars.cell_count(), some.size());
    std::set<EdgeVertices> of_some;
    const EdgeIndex other{stars.end_index().value() - 1U};
    for (std::size_t k = 0; k < some.size(); ++k) {
        ASSERT_EQ(stars.cell_at(k), some[k]);
        for (std::size_t e = 0; e < 6; ++e) {
            const VertexIndex a = mesh.cells[some[k]][cell_edges[e][0]];
            const VertexIndex b = mesh.cells[some[k]][cell_edges[e][1]];
            const EdgeVertices edge{std::min(a, b), std::max(a, b)};
            of_some.insert(edge);
            EXPECT_EQ(stars.edges_of(some[k])[e], stars.find(edge[0], edge[1]));
            EXPECT_NE(stars.edges_of(some[k])[e], other);
        }
    }
    EXPECT_EQ(other.value(), of_some.size());
    for (const auto& [edge, cells] : test::cells_at_edges(mesh)) {
        EXPECT_EQ(stars.find(edge[0], edge[1]) == other, !of_some.contains(edge));
    }
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        if (std::ranges::binary_search(some, c)) continue;
        for (const EdgeIndex e : stars.edges_of(c)) EXPECT_EQ(e, other);
    }
}

/// Further edges of a hub are found through a separate table.
TEST(EdgeNumbering, OfSomeCellsFindNoOtherEdgeOfAHub) {
    const Mesh mesh = fan(200);
    std::vector<CellIndex> some;
    for (std::size_t c = 0; c < 150; ++c) some.emplace_back(c);
    const EdgeNumbering stars(mesh.points.size(), mesh.cells, some);
    const EdgeIndex other{stars.end_index().value() - 1U};
    const VertexIndex hub{0};
    EXPECT_NE(stars.find(hub, mesh.cells[CellIndex{149}][3]), other);
    EXPECT_EQ(stars.find(hub, mesh.cells[CellIndex{151}][3]), other);
}

}  // namespace
}  // namespace octetra::distributed
