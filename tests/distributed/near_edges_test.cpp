#include "near_edges.hpp"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include <octetra/distributed/distributed_mesh.hpp>

#include "support/meshes.hpp"

namespace octetra::distributed {
namespace {

constexpr std::size_t n = 12;

DistributedMesh lattice() {
    Mesh mesh = test::kuhn(n, n, n);
    const std::vector<int> parts(mesh.cells.size(), 0);
    return distribute({}, std::move(mesh), parts);
}

ChosenCells chosen(std::vector<CellIndex> cells) {
    ChosenCells result;
    result.count = cells.size();
    result.cells = std::move(cells);
    return result;
}

/// Has every cell that an edge of these cells touches edges of its own, if surround() says so?
void expect_to_know_what_surrounds(const DistributedMesh& mesh, const NearEdges& edges) {
    const EdgeStars& stars = edges.stars();
    std::vector<std::uint8_t> has_edges(mesh.cells.size(), 0);
    for (std::size_t k = 0; k < stars.cell_count(); ++k) has_edges[stars.cell_at(k).value()] = 1;
    std::map<EdgeVertices, bool> is_surrounded;
    const auto edge_of = [&](CellIndex c, std::size_t e) {
        const VertexIndex a = mesh.cells[c][cell_edges[e][0]];
        const VertexIndex b = mesh.cells[c][cell_edges[e][1]];
        return EdgeVertices{std::min(a, b), std::max(a, b)};
    };
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (std::size_t e = 0; e < 6; ++e) {
            auto& known = is_surrounded.try_emplace(edge_of(c, e), true).first->second;
            known = known && has_edges[c.value()] != 0;
        }
    }
    std::size_t surrounded = 0;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (std::size_t e = 0; e < 6; ++e) {
            if (!edges.surround(c, e)) continue;
            ++surrounded;
            EXPECT_TRUE(is_surrounded.at(edge_of(c, e))) << "cell " << c.value();
        }
    }
    EXPECT_GE(surrounded, stars.cell_count());
}

TEST(NearEdges, AreThoseOfTheCellsWithinTwoEdgesAndThenTwiceAsFar) {
    const DistributedMesh mesh = lattice();
    NearEdges edges(mesh, chosen({CellIndex{0}}));  // at the corner 0 0 0
    for (const double reach :
         {4.0, 6.0, 10.0}) {  // 1 and the rings, and the cells at the last ones
        double farthest = 0;
        for (std::size_t k = 0; k < edges.stars().cell_count(); ++k) {
            for (const VertexIndex v : mesh.cells[edges.stars().cell_at(k)]) {
                const auto [x, y, z] = mesh.points[v];
                farthest = std::max({farthest, x, y, z});
            }
        }
        EXPECT_EQ(farthest, reach);
        expect_to_know_what_surrounds(mesh, edges);
        edges.widen();
    }
    EXPECT_EQ(edges.stars().cell_count(), mesh.cells.size()) << "too many to number only theirs";
}

TEST(NearEdges, AreAllWhereThatIsHalfOfTheCells) {
    const DistributedMesh mesh = lattice();
    std::vector<CellIndex> half;
    for (std::size_t c = 0; c < mesh.cells.size() / 2; ++c) half.emplace_back(c);
    const NearEdges edges(mesh, chosen(half));
    EXPECT_EQ(edges.stars().cell_count(), mesh.cells.size());
    expect_to_know_what_surrounds(mesh, edges);
}

TEST(NearEdges, BecomeAllHoweverFarAPathLeads) {
    const DistributedMesh mesh = lattice();
    NearEdges edges(mesh, chosen({CellIndex{mesh.cells.size() / 2}}));
    int times = 0;
    for (; edges.stars().cell_count() < mesh.cells.size(); ++times) {
        ASSERT_LT(times, 5);
        edges.widen();
    }
    EXPECT_GE(times, 1);
    expect_to_know_what_surrounds(mesh, edges);
}

TEST(NearEdges, TakeInWhatIsSharedWithOthers) {
    DistributedMesh mesh = lattice();
    const CellVertices& last = mesh.cells.back();
    mesh.interfaces.push_back({.rank = 1, .edges = {{last[0], last[1]}}, .faces = {}});
    NearEdges edges(mesh, chosen({CellIndex{0}}));
    const EdgeIndex other{edges.stars().end_index().value() - 1U};
    EXPECT_NE(edges.stars().find(last[0], last[1]), other);
    expect_to_know_what_surrounds(mesh, edges);
}

}  // namespace
}  // namespace octetra::distributed
