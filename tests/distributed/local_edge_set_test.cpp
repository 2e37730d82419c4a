#include "level/full_sweep/local_edge_set.hpp"

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

constexpr double default_share = 0.5;  // the default of Tuning

MarkedCells marked(std::vector<CellIndex> cells) {
    MarkedCells result;
    result.count = cells.size();
    result.cells = std::move(cells);
    return result;
}

/// Checks that all cells at an edge of these cells have numbered edges, if is_surrounded() returns
/// true.
void expect_surroundings_to_be_numbered(const DistributedMesh& mesh, const LocalEdgeSet& edges) {
    const EdgeNumbering& numbering = edges.numbering();
    std::vector<std::uint8_t> has_edges(mesh.cells.size(), 0);
    for (std::size_t k = 0; k < numbering.cell_count(); ++k)
        has_edges[numbering.cell_at(k).value()] = 1;
    std::map<EdgeVertices, bool> all_have;
    const auto edge_of = [&](CellIndex c, std::size_t e) {
        const VertexIndex a = mesh.cells[c][cell_edges[e][0]];
        const VertexIndex b = mesh.cells[c][cell_edges[e][1]];
        return EdgeVertices{std::min(a, b), std::max(a, b)};
    };
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (std::size_t e = 0; e < 6; ++e) {
            auto& known = all_have.try_emplace(edge_of(c, e), true).first->second;
            known = known && has_edges[c.value()] != 0;
        }
    }
    std::size_t surrounded = 0;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (std::size_t e = 0; e < 6; ++e) {
            if (!edges.is_surrounded(c, e)) continue;
            ++surrounded;
            EXPECT_TRUE(all_have.at(edge_of(c, e))) << "cell " << c.value();
        }
    }
    EXPECT_GE(surrounded, numbering.cell_count());
}

TEST(LocalEdgeSet, AreThoseOfTheCellsWithinTwoEdgesThenTwiceAsFarAndThenAll) {
    const DistributedMesh mesh = lattice();
    LocalEdgeSet edges(mesh, marked({CellIndex{0}}), default_share);  // at the corner 0 0 0
    for (const double reach : {4.0, 6.0}) {  // 1 plus the rings, and the cells at the last ring
        double farthest = 0;
        for (std::size_t k = 0; k < edges.numbering().cell_count(); ++k) {
            for (const VertexIndex v : mesh.cells[edges.numbering().cell_at(k)]) {
                const auto [x, y, z] = mesh.points[v];
                farthest = std::max({farthest, x, y, z});
            }
        }
        EXPECT_EQ(farthest, reach);
        expect_surroundings_to_be_numbered(mesh, edges);
        edges.widen();
    }
    EXPECT_EQ(edges.numbering().cell_count(), mesh.cells.size())
        << "or a long path would take for ever";
}

TEST(LocalEdgeSet, AreAllWhereThatIsHalfOfTheCells) {
    const DistributedMesh mesh = lattice();
    std::vector<CellIndex> half;
    for (std::size_t c = 0; c < mesh.cells.size() / 2; ++c) half.emplace_back(c);
    const LocalEdgeSet edges(mesh, marked(half), default_share);
    EXPECT_EQ(edges.numbering().cell_count(), mesh.cells.size());
    expect_surroundings_to_be_numbered(mesh, edges);
}

TEST(LocalEdgeSet, BecomeAllWhereTwiceAsFarIsTooMany) {
    const DistributedMesh mesh = lattice();
    // 4 % of the cells are within 4 of the corner, 12 % within 6.
    LocalEdgeSet edges(mesh, marked({CellIndex{0}}), 0.05);
    EXPECT_LT(edges.numbering().cell_count(), mesh.cells.size());
    edges.widen();
    EXPECT_EQ(edges.numbering().cell_count(), mesh.cells.size());
    expect_surroundings_to_be_numbered(mesh, edges);
}

TEST(LocalEdgeSet, IncludeEdgesSharedWithOtherRanks) {
    DistributedMesh mesh = lattice();
    const CellVertices& last = mesh.cells.back();
    mesh.interfaces.push_back({.rank = 1, .edges = {{last[0], last[1]}}, .faces = {}});
    LocalEdgeSet edges(mesh, marked({CellIndex{0}}), default_share);
    const EdgeIndex other{edges.numbering().end_index().value() - 1U};
    EXPECT_NE(edges.numbering().find(last[0], last[1]), other);
    expect_surroundings_to_be_numbered(mesh, edges);
}

}  // namespace
}  // namespace octetra::distributed
