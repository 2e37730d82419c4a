#include <gtest/gtest.h>

#include "reference/random_history.hpp"
#include "support/coarsening.hpp"

/// Coarsening of histories. Properties of the resulting mesh are tested in coarsened_mesh_test.cpp.
namespace octetra::reference {
namespace {

class RandomHistory : public testing::TestWithParam<std::uint64_t> {};

/// The composition of the maps with those of one more refinement.
RefinementMaps followed_by(const RefinementMaps& maps, const RefinementMaps& last) {
    RefinementMaps both = maps;
    both.cell_to_parent.clear();
    for (const CellIndex c : last.cell_to_parent) {
        both.cell_to_parent.append(maps.cell_to_parent[c]);
    }
    both.midpoint_to_edge.insert(both.midpoint_to_edge.end(), last.midpoint_to_edge.begin(),
                                 last.midpoint_to_edge.end());
    return both;
}

TEST_P(RandomHistory, IsReplayedAsRefinementMadeItStepByStep) {
    History history{random_input(GetParam()), {}};
    std::vector<Refinement> made{refine(history.input, {}, Scheme::eight, 0)};
    std::mt19937_64 random(GetParam());
    for (int i = 0; i < 4; ++i) {
        const Refinement& present = made.back();
        const Selection selection = about(2, present.mesh, random());
        const Scheme scheme = random_scheme(random);
        Refinement next = refine(present.mesh, selection, scheme, 1);
        next.maps = followed_by(present.maps, next.maps);
        history = refined(history, marked_cells(present, selection), scheme);
        if (next.mesh.cells.size() > present.mesh.cells.size()) made.push_back(next);
    }
    const auto replayed = replay(history);
    ASSERT_EQ(replayed.size(), made.size());
    for (std::size_t t = 0; t < made.size(); ++t) {
        EXPECT_EQ(replayed[t].mesh, made[t].mesh);
        EXPECT_EQ(replayed[t].maps, made[t].maps);
    }
}

TEST_P(RandomHistory, ContinuesFromACoarserMeshLikeRefinement) {
    for (const Call& call : random_calls(random_input(GetParam()), GetParam())) {
        if (call.coarsens || call.after == call.before) continue;
        const auto before = replay(call.before);
        const auto after = replay(call.after);
        ASSERT_EQ(after.size(), before.size() + 1);
        History alone{before.back().mesh, {}};
        EXPECT_EQ(after.back().mesh, replay(refined(alone, call.marked, call.scheme)).back().mesh);
        for (std::size_t t = 0; t < before.size(); ++t) EXPECT_EQ(after[t].mesh, before[t].mesh);
    }
}

class Coarsening : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Coarsening, LeavesClosedSetsOfEdgesThatAscend) {
    for (const Call& call : random_coarsenings(GetParam())) {
        const auto meshes = replay(call.after);
        for (std::size_t t = 0; t < call.after.steps.size(); ++t) {
            const auto& edges = call.after.steps[t];
            EXPECT_FALSE(edges.empty());
            EXPECT_TRUE(test::is_closed(meshes[t].mesh, edges));
            EXPECT_EQ(std::ranges::adjacent_find(edges, std::ranges::greater_equal{}), edges.end());
            for (const auto& [a, b] : edges) EXPECT_LT(a, b);
        }
        EXPECT_EQ(call.after.input, call.before.input);
    }
}

TEST_P(Coarsening, LeavesTheVerticesThatTheRulesForceAndNoOther) {
    for (const Call& call : random_coarsenings(GetParam())) {
        const auto left = test::points_of(replay(call.after).back().mesh);
        EXPECT_EQ(left, test::points_that_stay(call.before, call.marked).all);
    }
}

TEST_P(Coarsening, OfAllCellsRepeatedlyRestoresTheInput) {
    for (const Call& call : random_coarsenings(GetParam())) {
        History history = call.before;
        while (!history.steps.empty()) {
            const std::size_t steps = history.steps.size();
            const Refinement present = replay(history).back();
            history = coarsened(history, marked_cells(present, {.all = true}));
            ASSERT_LT(history.steps.size(), steps);  // nothing depends on the last step
        }
        EXPECT_EQ(history.input, call.before.input);
        EXPECT_EQ(replay(history).back().mesh, call.before.input);
    }
}

TEST_P(Coarsening, OfNoCellChangesNothing) {
    for (const Call& call : random_calls(random_input(GetParam()), GetParam())) {
        const CellMarks none(replay(call.after).back().mesh.cells.size(), false);
        EXPECT_EQ(coarsened(call.after, none), call.after);
        EXPECT_EQ(refined(call.after, none, call.scheme), call.after);
    }
}

TEST_P(Coarsening, OfFewerCellsRemovesNoAdditionalVertices) {
    std::mt19937_64 random(GetParam());
    for (const Call& call : random_coarsenings(GetParam())) {
        CellMarks fewer = call.marked;
        for (char& mark : fewer) {
            if (random() % 20 == 0) mark = 0;
        }
        const auto left = test::points_of(replay(call.after).back().mesh);
        const auto left_of_fewer =
            test::points_of(replay(coarsened(call.before, fewer)).back().mesh);
        EXPECT_TRUE(std::ranges::includes(left_of_fewer, left, std::less<>{}));
    }
}

TEST_P(Coarsening, OfTheCellsThatAStepMadeTakesItBack) {
    for (const Call& call : random_calls(random_input(GetParam()), GetParam())) {
        if (call.coarsens) continue;
        const Mesh before = replay(call.before).back().mesh;
        const Mesh after = replay(call.after).back().mesh;
        const std::set<CellVertices> old(before.cells.begin(), before.cells.end());
        CellMarks fresh;
        for (const CellVertices& cell : after.cells) fresh.append(!old.contains(cell));
        EXPECT_EQ(coarsened(call.after, fresh), call.before);
        EXPECT_EQ(refined(call.before, call.marked, call.scheme), call.after);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomHistory, testing::Range<std::uint64_t>(0, 6));
INSTANTIATE_TEST_SUITE_P(Seeds, Coarsening, testing::Range<std::uint64_t>(0, 12));

/// Counts the kinds of coarsening that occur.
struct Census {
    int calls = 0;
    int all_stays = 0;       ///< although cells are marked
    int part_of_a_step = 0;  ///< a step loses some edges and keeps others
    int several_steps = 0;   ///< lose edges
    int closure_adds = 0;    ///< rule (b) keeps edges that rule (a) does not
    int later_steps = 0;     ///< a step that has a later one loses edges
};

/// The number of edges that each step loses. Empty steps are removed, so edges are identified by
/// points.
std::vector<std::size_t> lost_edges(const Call& call) {
    const auto left = test::points_of(replay(call.after).back().mesh);
    const auto meshes = replay(call.before);
    std::vector<std::size_t> counts;
    for (std::size_t t = 0; t < call.before.steps.size(); ++t) {
        const auto edges = test::segments(meshes[t].mesh, call.before.steps[t]);
        counts.push_back(static_cast<std::size_t>(std::ranges::count_if(
            edges, [&](const auto& e) { return !left.contains(midpoint(e[0], e[1])); })));
    }
    return counts;
}

void count(const Call& call, Census& census) {
    const auto counts = lost_edges(call);
    const auto stay = test::points_that_stay(call.before, call.marked);
    bool part = false;
    for (std::size_t t = 0; t < counts.size(); ++t) {
        part = part || (counts[t] > 0 && counts[t] < call.before.steps[t].size());
        if (counts[t] > 0 && t + 1 < counts.size()) ++census.later_steps;
    }
    ++census.calls;
    const bool any_marked = std::ranges::count(call.marked, 0) < std::ssize(call.marked);
    census.all_stays += any_marked && call.after == call.before ? 1 : 0;
    census.part_of_a_step += part ? 1 : 0;
    census.several_steps +=
        std::ranges::count_if(counts, [](std::size_t n) { return n > 0; }) > 1 ? 1 : 0;
    census.closure_adds += stay.all.size() > stay.by_cells.size() ? 1 : 0;
}

TEST(RandomCoarsenings, MeetEveryRule) {
    Census census;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        for (const Call& call : random_coarsenings(seed)) count(call, census);
    }
    EXPECT_GT(census.calls, 30);
    EXPECT_GT(census.all_stays, 3);
    EXPECT_GT(census.part_of_a_step, 10);
    EXPECT_GT(census.several_steps, 5);
    EXPECT_GT(census.closure_adds, 5);
    EXPECT_GT(census.later_steps, 5);
}

}  // namespace
}  // namespace octetra::reference
