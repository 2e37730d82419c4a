#include <gtest/gtest.h>

#include <octetra/core/selection.hpp>

#include "rivals/gathered_parts.hpp"
#include "support/meshes.hpp"

/// Ranks send the necessary messages and no others.
namespace octetra::rivals {
namespace {

/// Collective. The traffic of all ranks together.
Traffic traffic_of(const Mesh& mesh, const Goal& goal, const std::vector<int>& part_of_cell) {
    const auto& world = test::world();
    PartOfMesh part = part_of(mesh, part_of_cell, world.rank());
    const Goal own = own_goal(goal, part);
    TerminalEdgesOnRanks bisection(world, std::move(part), mesh.points.size());
    Traffic told = bisection.refine(own);
    EXPECT_EQ(told.bytes, 4 * (told.asked + told.ready));
    EXPECT_EQ(world.max(told.rounds), told.rounds);
    for (std::uint64_t* of_rank :
         {&told.messages, &told.bytes, &told.asked, &told.ready, &told.shared_edges_bisected}) {
        *of_rank = world.sum(*of_rank);
    }
    return told;
}

TEST(Traffic, IsNoneWhereOneRankHasAll) {
    const Mesh mesh = test::kuhn(2, 2, 2);
    const int last = test::world().size() - 1;
    const auto told = traffic_of(mesh, {}, std::vector<int>(mesh.cells.size(), last));
    EXPECT_EQ(told.rounds + told.messages + told.bytes + told.shared_edges_bisected, 0U);
}

Mesh two_cells_at_their_longest_edge() {
    return test::mesh_of({{0, 0, 0}, {4, 0, 0}, {2, 1, 1}, {2, -1, 1}, {2, 1, -1}},
                         {{0, 1, 2, 3}, {0, 1, 2, 4}});
}

/// Each announces that it is ready to bisect the edge; then both bisect.
TEST(Traffic, OfTwoCellsThatShareTheirLongestEdgeIsAMessageEach) {
    if (test::world().size() == 1) return;
    const auto told = traffic_of(two_cells_at_their_longest_edge(), {}, {0, 1});
    EXPECT_EQ(told.rounds, 1U);
    EXPECT_EQ(told.messages, 2U);
    EXPECT_EQ(told.asked, 0U);
    EXPECT_EQ(told.ready, 2U);
    EXPECT_EQ(told.bytes, 8U);
    EXPECT_EQ(told.shared_edges_bisected, 2U);
}

/// If only one cell is a target, the other rank is notified, and then announces that it is ready.
TEST(Traffic, OfTwoCellsOfWhichOneIsATargetIsARequestAndAReply) {
    if (test::world().size() == 1) return;
    const auto told = traffic_of(two_cells_at_their_longest_edge(), {.targets = {1, 0}}, {0, 1});
    EXPECT_EQ(told.rounds, 2U);
    EXPECT_EQ(told.messages, 2U);
    EXPECT_EQ(told.asked, 0U);
    EXPECT_EQ(told.ready, 2U);
}

/// Every cell of the shell waits for the next: the path crosses the border between the ranks in
/// both directions, as often as the shell does.
TEST(Traffic, FollowsAPathFromRankToRank) {
    const auto ranks = static_cast<std::size_t>(test::world().size());
    constexpr std::size_t cells = 40;
    Goal goal;
    goal.targets.assign(cells, 0);
    goal.targets.front() = 1;
    const Mesh mesh = test::shell(cells, 3);
    std::vector<int> in_turn;
    std::vector<int> blocks;
    for (const CellVertices& cell : mesh.cells) {
        const std::size_t place = std::ranges::min(cell).value();  // from the end of the shell
        in_turn.push_back(static_cast<int>(place % ranks));
        blocks.push_back(static_cast<int>(place * ranks / cells));
    }
    const auto often = traffic_of(mesh, goal, in_turn);
    const auto seldom = traffic_of(mesh, goal, blocks);
    if (ranks == 1) return;
    EXPECT_GE(often.rounds, cells);
    EXPECT_LE(often.rounds, 3 * cells);
    EXPECT_LE(seldom.rounds, 6 * ranks);
    EXPECT_GE(often.ready, cells);
    if (ranks == 2) {  // one of which often has a cell in its own way, too
        EXPECT_GT(often.asked, cells / 2);
    }
}

}  // namespace
}  // namespace octetra::rivals
