#include <algorithm>
#include <bitset>
#include <set>

#include <gtest/gtest.h>

#include "bisect.hpp"
#include "closure.hpp"
#include "support/conformity.hpp"
#include "support/meshes.hpp"
#include "support/refinement.hpp"

/// One cell in all its 24 vertex orders, with all 64 selections of its edges.
namespace octetra::reference {
namespace {

/// The children of a cell; `selection` marks its edges, pairs of corner positions in `corners`.
Mesh bisected(const std::array<Point, 4>& corners, std::array<std::size_t, 4> order,
              unsigned selection) {
    Mesh mesh;
    for (const Point& p : corners) mesh.points.append(p);
    mesh.cells.append({VertexIndex{order[0]}, VertexIndex{order[1]}, VertexIndex{order[2]},
                       VertexIndex{order[3]}});
    const EdgeTable table = number_edges(mesh);
    EdgeSet marked(6, false);
    for (EdgeIndex e{0}; e < marked.end_index(); ++e) {
        marked[e] = static_cast<char>(selection >> e.value() & 1U);
    }
    marked = close(marked, mesh, table);
    EdgeToMidpoint midpoints(6, VertexIndex::none());
    Mesh fine;
    fine.points = mesh.points;
    for (EdgeIndex e{0}; e < marked.end_index(); ++e) {
        if (marked[e] == 0) continue;
        const auto& [a, b] = table.edges[e];
        midpoints[e] = fine.points.append(midpoint(mesh.points[a], mesh.points[b]));
    }
    for (const auto& child : pieces_of(mesh.cells.front(), mesh, table, midpoints)) {
        fine.cells.append(child);
    }
    return fine;
}

class OneCell : public testing::TestWithParam<std::array<Point, 4>> {};

TEST_P(OneCell, IsBisectedIdenticallyInEveryVertexOrder) {
    for (unsigned selection = 0; selection < 64; ++selection) {
        std::array<std::size_t, 4> order{0, 1, 2, 3};
        const auto expected = test::geometry(bisected(GetParam(), order, selection));
        do {
            const Mesh fine = bisected(GetParam(), order, selection);
            ASSERT_EQ(test::geometry(fine), expected);
        } while (std::ranges::next_permutation(order).found);
    }
}

TEST_P(OneCell, KeepsItsOrientationAndIsFilledExactly) {
    const auto whole = test::exact_volume(GetParam(), 8);
    for (unsigned selection = 0; selection < 64; ++selection) {
        std::array<std::size_t, 4> order{0, 1, 2, 3};
        do {
            const Mesh fine = bisected(GetParam(), order, selection);
            const auto turned = test::exact_volume({GetParam()[order[0]], GetParam()[order[1]],
                                                    GetParam()[order[2]], GetParam()[order[3]]},
                                                   8);
            ASSERT_EQ(turned > 0 ? turned : -turned, whole > 0 ? whole : -whole);
            test::Int128 sum = 0;
            for (CellIndex c{0}; c < fine.cells.end_index(); ++c) {
                const auto volume = test::exact_volume(test::corners_of(fine, c), 8);
                ASSERT_TRUE((volume > 0) == (turned > 0) && volume != 0);
                sum += volume;
            }
            ASSERT_TRUE(sum == turned);
            ASSERT_EQ(test::count_faces(fine).faults, 0U);
        } while (std::ranges::next_permutation(order).found);
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, OneCell,
                         testing::Values(test::regular_corners, test::kuhn_corners,
                                         test::cube_corner, test::sommerville_corners,
                                         test::tie_free_corners, test::type_o_corners));

TEST(Bisection, Child1KeepsTheEndAtTheLowerPositionAndMidpointsReplaceTheOther) {
    const Mesh mesh = test::one_cell(test::tie_free_corners);
    const EdgeTable table = number_edges(mesh);
    EdgeToMidpoint midpoints(6, VertexIndex::none());
    midpoints[find_edge(table, VertexIndex{1}, VertexIndex{3})] = VertexIndex{4};
    const auto children = pieces_of(mesh.cells.front(), mesh, table, midpoints);
    ASSERT_EQ(children.size(), 2U);
    const auto cell = [](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
        return CellVertices{VertexIndex{a}, VertexIndex{b}, VertexIndex{c}, VertexIndex{d}};
    };
    ASSERT_EQ(mesh.cells.front(), cell(0, 1, 2, 3));
    EXPECT_EQ(children[0], cell(0, 1, 2, 4));
    EXPECT_EQ(children[1], cell(0, 4, 2, 3));
}

}  // namespace
}  // namespace octetra::reference
