#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/reference/refine.hpp>

#include "distributed/moving_mesh.hpp"
#include "distributed/observed_mesh.hpp"
#include "distributed/shared_folder.hpp"
#include "support/refinement.hpp"

/// Tests of roots that are replaced by descendants because they are too heavy.
namespace octetra::distributed {
namespace {

/// Migrates for the least improvement of the balance.
constexpr BalanceOptions forgetting{.most_over_mean = 1, .may_forget_history = true};

/// One cube of six cells: with more cells, random marks almost always leave some roots light enough
/// to balance the ranks.
constexpr std::size_t cubes = 1;

/// 20 steps that approach a corner, which few cells of the input contain.
std::vector<Selection> approaching_steps() {
    std::vector<Selection> steps;
    double radius = 0.9;
    for (int k = 0; k < 20; ++k, radius *= 0.55)
        steps.push_back({.spheres = {{{0, 0, 0}, radius}}});
    return steps;
}

class ForgottenHistory : public testing::TestWithParam<std::uint64_t> {};

/// Point markers and attributes, regions, tags and features are preserved as well.
TEST_P(ForgottenHistory, ChangesNoStepAndNoFile) {
    std::mt19937_64 random(GetParam());
    MovingAndResting pair(GetParam(), cubes);
    bool has_forgotten = false;
    for (int k = 0; k < 6; ++k) {
        constexpr std::array<double, 4> shares{0.05, 0.1, 0.2, 0.3};
        const std::uint64_t seed = random();  // argument evaluation is unordered
        const Selection selection = some(shares[random() % shares.size()], seed);
        (void)pair.moving.refine_evenly(selection, forgetting);
        (void)pair.resting.refine(selection);
        if (k == 2) (void)pair.moving.rebalance(forgetting);
        SCOPED_TRACE(k);
        pair.expect_step(selection, true);
        ASSERT_FALSE(HasFailure());
        const std::uint64_t all = test::world().sum(pair.moving.roots().size());
        has_forgotten = has_forgotten || all > test::world().sum(pair.resting.roots().size());
    }
    EXPECT_EQ(has_forgotten, test::world().size() > 1);
}

TEST_P(ForgottenHistory, IsNotInACheckpointWhichContinuesIdentically) {
    AdaptiveMesh mesh = distributed_mesh(input_of(GetParam(), cubes), "block");
    for (std::uint64_t k = 0; k < 4; ++k) {
        (void)mesh.refine_evenly(some(0.3, GetParam() + k), forgetting);
    }
    const test::SharedFolder folder;
    mesh.save(folder / "a.octetra");
    AdaptiveMesh loaded = AdaptiveMesh::load(test::world(), folder / "a.octetra");
    EXPECT_TRUE(loaded.collect() == mesh.collect());
    (void)loaded.refine(some(0.1, GetParam()));
    (void)mesh.refine(some(0.1, GetParam()));
    EXPECT_TRUE(loaded.collect() == mesh.collect());
}

/// The engine alone, without maps.
TEST_P(ForgottenHistory, OfManyLevelsGivesTheMeshOfTheReference) {
    const Mesh input = input_of(GetParam(), cubes);
    const auto parts = partition_cells(input, test::world().size(), parse_partition("block"));
    for (const Selection& selection : {some(0.2, GetParam()), some(0.6, GetParam())}) {
        DistributedMesh mesh = distribute(test::world(), input, parts);
        refine(mesh, selection, {.levels = 3, .balance = forgetting});
        const Collected found = collect(std::move(mesh));
        if (!test::world().is_first()) continue;
        EXPECT_TRUE(found.mesh == reference::refine(input, selection, Scheme::eight, 3).mesh);
    }
}

/// Collective. Recalls all forgotten history, and checks that points migrate with their vertices.
int recall_all(AdaptiveMesh& mesh) {
    int times = 0;
    for (; mesh.has_forgotten_history(); ++times) {
        std::vector<Point> points(mesh.points().begin(), mesh.points().end());
        const Migration move = mesh.recall_history();
        EXPECT_TRUE(std::ranges::equal(move.vertices(std::move(points)), mesh.points()));
    }
    EXPECT_FALSE(mesh.recall_history().changed());
    return times;
}

/// Migrates each root to a random rank.
void scatter(AdaptiveMesh& mesh, std::uint64_t seed) {
    std::vector<int> ranks;
    for (const std::uint64_t root : mesh.roots()) {
        std::mt19937_64 random(root ^ seed);
        ranks.push_back(static_cast<int>(random() % static_cast<unsigned>(test::world().size())));
    }
    (void)mesh.migrate(ranks);
}

/// The same mesh, loaded with a random partition. The lowest process with an adjacent cell has a
/// tagged facet or edge; the process of the first such cell need not have it.
AdaptiveMesh loaded_again(const AdaptiveMesh& mesh, std::uint64_t seed) {
    const test::SharedFolder folder;
    mesh.save(folder / "a.octetra");
    return AdaptiveMesh::load(test::world(), folder / "a.octetra",
                              {.method = PartitionMethod::random, .seed = seed});
}

/// After refinement and migration, coarsening and checkpoints are unaffected by the forgotten
/// history.
TEST_P(ForgottenHistory, IsRecalledWithLaterRefinement) {
    MovingAndResting pair(GetParam(), cubes);
    if (GetParam() % 2 == 1) pair.moving = loaded_again(pair.moving, GetParam());
    int recalled = 0;
    for (std::uint64_t round = 0; round < 2; ++round) {
        for (std::uint64_t k = 0; k < 3; ++k) {
            const Selection selection = some(round == 0 ? 0.3 : 0.03, GetParam() + 10 * round + k);
            (void)pair.moving.refine_evenly(selection, forgetting);
            (void)pair.resting.refine(selection);
            pair.expect_step(selection, true);
            if (round == 1) scatter(pair.moving, k);
            if (k == 2) (void)pair.moving.rebalance(forgetting);
        }
        recalled += recall_all(pair.moving);
        EXPECT_EQ(test::world().sum(pair.moving.roots().size()),
                  test::world().sum(pair.resting.roots().size()));
        pair.expect_same_checkpoints();
        scatter(pair.moving, 3 + round);
        EXPECT_TRUE(pair.moving.collect() == pair.resting.collect());
        for (std::uint64_t k = 0; k < 2; ++k) {
            const Selection selection = some(0.7, GetParam() + 10 * round + k);
            (void)pair.moving.coarsen(selection);
            (void)pair.resting.coarsen(selection);
            pair.expect_step(selection, false);
        }
        pair.expect_same_checkpoints();
        ASSERT_FALSE(HasFailure());
    }
    EXPECT_GE(recalled, test::world().size() > 1 ? 1 : 0);
}

/// This takes back only the levels above the forgotten history.
TEST_P(ForgottenHistory, IsRecalledAfterCoarseningThatEndedWithIt) {
    AdaptiveMesh mesh = distributed_mesh(input_of(GetParam(), cubes), "block");
    const Mesh input = mesh.collect();
    for (std::uint64_t k = 0; k < 5; ++k) {
        (void)mesh.refine_evenly(some(0.3, GetParam() + k), forgetting);
    }
    while (mesh.coarsen(Selection{.all = true}).changed) {
    }
    const Mesh roots = mesh.collect();
    (void)recall_all(mesh);
    EXPECT_TRUE(mesh.collect() == roots);
    while (mesh.coarsen(Selection{.all = true}).changed) {
    }
    EXPECT_TRUE(mesh.collect() == input);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ForgottenHistory, testing::Range<std::uint64_t>(0, 4));

TEST(ForgottenHistory, BalancesProcessesWhereFewRootsHaveMostCells) {
    AdaptiveMesh forgetful = distributed_mesh(test::kuhn(2, 2, 2, 1.0 / 2), "block");
    AdaptiveMesh faithful = distributed_mesh(test::kuhn(2, 2, 2, 1.0 / 2), "block");
    for (const Selection& selection : approaching_steps()) {
        (void)forgetful.refine_evenly(selection,
                                      {.most_over_mean = 1.1, .may_forget_history = true});
        (void)faithful.refine_evenly(selection, {.most_over_mean = 1.1});
    }
    EXPECT_LE(most_over_mean(forgetful), 1.15);
    // Up to three processes can share the corner evenly.
    EXPECT_EQ(most_over_mean(faithful) > 1.15, test::world().size() > 3);
    EXPECT_TRUE(forgetful.collect() == faithful.collect());
}

/// No single level justifies migration, but all levels together do. Processes become unbalanced
/// between migrations, so the criterion is the accumulated time of the slowest process.
TEST(ForgottenHistory, MigratesCellsWhenAccumulatedWaitingJustifiesIt) {
    AdaptiveMesh mesh = distributed_mesh(test::kuhn(2, 2, 2, 1.0 / 2), "block");
    AdaptiveMesh unmoved = distributed_mesh(test::kuhn(2, 2, 2, 1.0 / 2), "block");
    int moves = 0;
    std::uint64_t time = 0;
    std::uint64_t time_unmoved = 0;
    for (const Selection& selection : approaching_steps()) {
        const auto done = mesh.refine_evenly(
            selection,
            {.most_over_mean = 1.1, .only_if_it_pays = true, .may_forget_history = true});
        (void)unmoved.refine(selection);
        moves += done.move.changed() ? 1 : 0;
        time += test::world().max(mesh.cells().size());
        time_unmoved += test::world().max(unmoved.cells().size());
    }
    EXPECT_LE(10 * time, (test::world().size() == 1 ? 10 : 6) * time_unmoved);
    EXPECT_GE(moves, std::min(2, test::world().size() / 2));
    EXPECT_LE(moves, 10);
}

/// Repeatedly marking all cells ends at the mesh whose cells are the roots.
TEST(ForgottenHistory, IsWhereCoarseningEnds) {
    AdaptiveMesh mesh = distributed_mesh(input_of(1, cubes), "block");
    Mesh last = mesh.collect();  // before its history was forgotten
    bool has_forgotten = false;
    for (std::uint64_t k = 0; k < 6; ++k) {
        const Mesh before = mesh.collect();
        const std::uint64_t roots = test::world().sum(mesh.roots().size());
        (void)mesh.refine_evenly(some(0.3, k), forgetting);
        if (test::world().sum(mesh.roots().size()) == roots) continue;
        last = before;
        has_forgotten = true;
    }
    EXPECT_EQ(has_forgotten, test::world().size() > 1);
    for (Adaptation step = mesh.coarsen(Selection{.all = true}); step.changed;) {
        step = mesh.coarsen(Selection{.all = true});
    }
    EXPECT_TRUE(mesh.collect() == last);
}

/// The migration is undone if the step is refused.
TEST(ForgottenHistory, IsThereStillAfterAStepThatIsRefused) {
    Mesh whole = test::kuhn(3, 3, 3, 8);
    for (Point& p : whole.points) p = {p.x + 0x1p52, p.y + 0x1p52, p.z + 0x1p52};
    const Selection corner{
        .boxes = {{{0x1p52, 0x1p52, 0x1p52}, {0x1p52 + 9, 0x1p52 + 9, 0x1p52 + 9}}}};
    AdaptiveMesh mesh = distributed_mesh(whole, "block");
    bool is_refused = false;
    for (int k = 0; k < 6 && !is_refused; ++k) {
        const test::ObservedMesh before(mesh);
        const std::vector<std::uint64_t> roots(mesh.roots().begin(), mesh.roots().end());
        try {
            if (k < 2) (void)mesh.refine(corner);
            if (k >= 2) (void)mesh.refine_evenly(corner, forgetting);
        } catch (const InputError&) {
            EXPECT_TRUE(before == test::ObservedMesh(mesh));
            EXPECT_TRUE(std::ranges::equal(roots, mesh.roots()));
            is_refused = true;
        }
    }
    EXPECT_TRUE(is_refused);
}

}  // namespace
}  // namespace octetra::distributed
