#include "lookup/edge_set.hpp"

#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support/meshes.hpp"

namespace octetra::verify {
namespace {

void expect_every_edge_once(const Mesh& mesh) {
    std::set<EdgeVertices> expected;
    const auto for_each_edge = [&](auto&& visit) {
        for (const CellVertices& cell : mesh.cells) {
            for (const auto& [i, j] : cell_edges) visit(EdgeVertices{cell[i], cell[j]});
        }
    };
    for_each_edge([&](const EdgeVertices& edge) {
        expected.insert({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
    });
    const EdgeSet edges(mesh.points.size(), for_each_edge);
    std::vector<EdgeVertices> found;
    edges.for_each([&](const EdgeVertices& edge) { found.push_back(edge); });
    EXPECT_TRUE(std::ranges::equal(found, expected));
    for (const auto& [low, high] : expected) {
        ASSERT_TRUE(edges.contains({low, high}));
        ASSERT_TRUE(edges.contains({high, low}));
        const VertexIndex beyond{high.value() + 1U};
        ASSERT_EQ(edges.contains({low, beyond}), expected.contains({low, beyond}));
    }
}

TEST(EdgeSet, HasEveryEdgeOfTheCellsOnce) {
    expect_every_edge_once({});
    expect_every_edge_once(test::one_cell(test::cube_corner));
    expect_every_edge_once(test::kuhn(3, 2, 4));
}

/// 497,664 edges of cells, several times the number processed in one block.
TEST(EdgeSet, HasThemOnceWhereItIsMadeInTurns) { expect_every_edge_once(test::kuhn(24, 24, 24)); }

}  // namespace
}  // namespace octetra::verify
