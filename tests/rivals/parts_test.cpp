#include <random>

#include <gtest/gtest.h>

#include <octetra/core/selection.hpp>

#include "rivals/parts.hpp"
#include "support/meshes.hpp"

/// On parts the same cells are cut, and there is as much to tell as there is at the border.
namespace octetra::rivals {
namespace {

std::vector<int> random_parts(std::size_t cells, std::size_t parts, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<int> part_of_cell(cells);
    for (int& part : part_of_cell) part = static_cast<int>(random() % parts);
    return part_of_cell;
}

/// A cell and what is reached from it: once, or until it is small.
std::vector<Goal> goals_of(const Mesh& mesh) {
    Goal goal;
    goal.targets.assign(mesh.cells.size(), 0);
    goal.targets.front() = 1;
    const auto& [a, b, c, d] = mesh.cells.front();
    const Corners corners{mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]};
    return {goal, {.targets = goal.targets, .volume = volume(corners) / 40}};
}

TEST(Parts, MakeTheSameCellsHoweverManyThereAre) {
    std::uint64_t shared = 0;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        for (const Mesh& mesh :
             {test::kuhn(3, 3, 3), test::shaken_kuhn(3, 0.3, seed), test::shell(40, seed)}) {
            for (const Goal& goal : goals_of(mesh)) {
                TerminalEdgeBisection serial(mesh);
                (void)serial.refine(goal);
                for (const std::size_t parts : {2U, 3U, 1000U}) {
                    const auto counts =
                        count_on_parts(mesh, goal, random_parts(mesh.cells.size(), parts, seed));
                    EXPECT_EQ(counts.cells, serial.cell_count());
                    shared += counts.shared_edges_bisected;
                    EXPECT_EQ(counts.bytes, 4 * (counts.asked + counts.ready));
                }
            }
        }
    }
    EXPECT_GT(shared, 1000U);
}

TEST(Parts, SayNothingWhereThereIsOneAlone) {
    const Mesh mesh = test::kuhn(2, 2, 2);
    const auto counts = count_on_parts(mesh, {}, std::vector<int>(mesh.cells.size(), 0));
    EXPECT_EQ(counts.rounds + counts.messages + counts.bytes + counts.shared_edges_bisected, 0U);
}

/// Two cells at a face that has the longest edge of both: each says that it wants it, and that
/// nothing is in its way; in the round after it is bisected.
TEST(Parts, OfTwoCellsThatShareTheirLongestEdgeSayWhatTheyHaveToInOneRound) {
    const Mesh mesh = test::mesh_of({{0, 0, 0}, {4, 0, 0}, {2, 1, 1}, {2, -1, 1}, {2, 1, -1}},
                                    {{0, 1, 2, 3}, {0, 1, 2, 4}});
    const PartsCounts counts = count_on_parts(mesh, {}, {0, 1});
    EXPECT_EQ(counts.rounds, 1U);
    EXPECT_EQ(counts.messages, 2U);
    EXPECT_EQ(counts.asked, 2U);
    EXPECT_EQ(counts.ready, 2U);
    EXPECT_EQ(counts.bytes, 16U);
    EXPECT_EQ(counts.shared_edges_bisected, 1U);
    EXPECT_EQ(counts.cells, 4U);
}

/// If one alone is a target, the other learns of it, and then says that it is ready.
TEST(Parts, OfWhichOneIsATargetSpeakInTurn) {
    const Mesh mesh = test::mesh_of({{0, 0, 0}, {4, 0, 0}, {2, 1, 1}, {2, -1, 1}, {2, 1, -1}},
                                    {{0, 1, 2, 3}, {0, 1, 2, 4}});
    const PartsCounts counts = count_on_parts(mesh, {.targets = {1, 0}}, {0, 1});
    EXPECT_EQ(counts.rounds, 2U);
    EXPECT_EQ(counts.messages, 2U);
    EXPECT_EQ(counts.asked, 1U);
    EXPECT_EQ(counts.ready, 2U);
}

}  // namespace
}  // namespace octetra::rivals
