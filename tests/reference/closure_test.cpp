#include <random>

#include <gtest/gtest.h>

#include "closure.hpp"
#include "mark_edges.hpp"
#include "support/meshes.hpp"

namespace octetra::reference {
namespace {

EdgeSet random_edges(const EdgeTable& table, double share, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    EdgeSet set(table.edges.size(), false);
    for (char& marked : set) marked = static_cast<double>(random()) * 0x1p-64 < share ? 1 : 0;
    return set;
}

bool contains(const EdgeSet& large, const EdgeSet& small) {
    for (EdgeIndex e{0}; e < small.end_index(); ++e) {
        if (small[e] != 0 && large[e] == 0) return false;
    }
    return true;
}

class Closure : public testing::TestWithParam<std::uint64_t> {
protected:
    const Mesh mesh =
        GetParam() % 2 == 0 ? test::kuhn(3, 3, 3) : test::perturbed_kuhn(3, 0.3, GetParam());
    const EdgeTable table = number_edges(mesh);
    const EdgeSet few = random_edges(table, 0.02, GetParam());
    const EdgeSet closed = close(few, mesh, table);
};

TEST_P(Closure, HasTheLongestEdgeOfEveryFaceThatItTouches) {
    EXPECT_TRUE(contains(closed, few));
    for (const auto& cell : table.cell_to_edges) {
        for (std::size_t f = 0; f < 4; ++f) {
            const auto edges = face_edges(cell, f);
            const bool touched =
                std::ranges::any_of(edges, [&](EdgeIndex e) { return closed[e] != 0; });
            ASSERT_TRUE(!touched || closed[longest(mesh, table, edges)] != 0);
        }
    }
}

TEST_P(Closure, IsIdempotent) { EXPECT_EQ(close(closed, mesh, table), closed); }

TEST_P(Closure, IsMonotone) {
    EdgeSet more = few;
    const EdgeSet others = random_edges(table, 0.02, GetParam() + 1000);
    for (EdgeIndex e{0}; e < more.end_index(); ++e) more[e] = more[e] | others[e];
    EXPECT_TRUE(contains(close(more, mesh, table), closed));
}

TEST_P(Closure, IsMinimal) {
    // Any closed set that contains the selection contains the closure. Hence removing from it one
    // edge that was not marked must leave a set that is not closed; otherwise the closure was not
    // minimal.
    for (EdgeIndex e{0}; e < closed.end_index(); ++e) {
        if (closed[e] == 0 || few[e] != 0) continue;
        EdgeSet without = closed;
        without[e] = 0;
        ASSERT_EQ(close(without, mesh, table)[e], 1);
    }
}

TEST_P(Closure, DoesNotDependOnTheOrderOfTheCells) {
    Mesh turned = mesh;
    std::ranges::reverse(turned.cells);
    const EdgeTable turned_table = number_edges(turned);
    ASSERT_EQ(turned_table.edges, table.edges);
    EXPECT_EQ(close(few, turned, turned_table), closed);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Closure, testing::Range<std::uint64_t>(0, 8));

TEST(Selection, SchemesSelectAllTheFacesLongestOrTheLongestEdge) {
    const Mesh mesh = test::one_cell(test::tie_free_corners);
    const EdgeTable table = number_edges(mesh);
    const auto marked = [&](Scheme scheme) { return mark_edges(mesh, table, {true}, scheme); };
    // Squared lengths: 01 49, 02 29, 03 41, 12 50, 13 76, 23 46.
    EXPECT_EQ(marked(Scheme::eight), (EdgeSet{1, 1, 1, 1, 1, 1}));
    // Faces: 123 has 13, 023 has 23, 013 has 13, 012 has 12.
    EXPECT_EQ(marked(Scheme::four), (EdgeSet{0, 0, 0, 1, 1, 1}));
    EXPECT_EQ(marked(Scheme::two), (EdgeSet{0, 0, 0, 0, 1, 0}));
}

}  // namespace
}  // namespace octetra::reference
