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
#include "distributed/seen_mesh.hpp"
#include "distributed/shared_folder.hpp"
#include "support/refinement.hpp"

/// Cells of the mesh that take the place of those of the input, where these are too heavy.
namespace octetra::distributed {
namespace {

/// Wherever it makes ranks more even by the least.
constexpr BalanceOptions forgetting{.most_over_mean = 1, .may_forget_history = true};

/// Ever nearer to a corner, which few cells of the input have: 20 times.
std::vector<Selection> to_a_corner() {
    std::vector<Selection> steps;
    double radius = 0.9;
    for (int k = 0; k < 20; ++k, radius *= 0.55)
        steps.push_back({.spheres = {{{0, 0, 0}, radius}}});
    return steps;
}

class ForgottenHistory : public testing::TestWithParam<std::uint64_t> {};

/// Point markers and attributes, regions, tags and features among what stays.
TEST_P(ForgottenHistory, ChangesNoStepAndNoFile) {
    std::mt19937_64 random(GetParam());
    MovingAndResting pair(GetParam());
    bool has_forgotten = false;
    for (int k = 0; k < 5; ++k) {
        constexpr std::array<double, 4> shares{0.001, 0.004, 0.03, 0.08};
        const Selection selection = some(shares[random() % shares.size()], random());
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

TEST_P(ForgottenHistory, IsNotInACheckpointWhichGoesOnAllTheSame) {
    AdaptiveMesh mesh = shared_out(input_of(GetParam()), "block");
    for (std::uint64_t k = 0; k < 4; ++k) {
        (void)mesh.refine_evenly(some(0.05, GetParam() + k), forgetting);
    }
    const test::SharedFolder folder;
    mesh.save(folder / "a.octetra");
    AdaptiveMesh loaded = AdaptiveMesh::load(test::world(), folder / "a.octetra");
    EXPECT_TRUE(loaded.collect() == mesh.collect());
    (void)loaded.refine(some(0.1, GetParam()));
    (void)mesh.refine(some(0.1, GetParam()));
    EXPECT_TRUE(loaded.collect() == mesh.collect());
}

/// The engine alone, of which nobody asks for maps.
TEST_P(ForgottenHistory, OfManyLevelsGivesTheMeshOfTheReference) {
    const Mesh input = input_of(GetParam());
    const auto parts = partition_cells(input, test::world().size(), parse_partition("block"));
    for (const Selection& selection : {some(0.01, GetParam()), some(0.2, GetParam())}) {
        DistributedMesh mesh = distribute(test::world(), input, parts);
        refine(mesh, selection, {.levels = 3, .balance = forgetting});
        const Collected found = collect(std::move(mesh));
        if (!test::world().is_first()) continue;
        EXPECT_TRUE(found.mesh == reference::refine(input, selection, Scheme::eight, 3).mesh);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ForgottenHistory, testing::Range<std::uint64_t>(0, 4));

TEST(ForgottenHistory, LetsProcessesBeEvenThatHaveACornerOfFewCells) {
    AdaptiveMesh forgetful = shared_out(test::kuhn(2, 2, 2, 1.0 / 2), "block");
    AdaptiveMesh faithful = shared_out(test::kuhn(2, 2, 2, 1.0 / 2), "block");
    for (const Selection& selection : to_a_corner()) {
        (void)forgetful.refine_evenly(selection,
                                      {.most_over_mean = 1.1, .may_forget_history = true});
        (void)faithful.refine_evenly(selection, {.most_over_mean = 1.1});
    }
    EXPECT_LE(most_over_mean(forgetful), 1.15);
    // Of three processes each has as much of the corner.
    EXPECT_EQ(most_over_mean(faithful) > 1.15, test::world().size() > 3);
    EXPECT_TRUE(forgetful.collect() == faithful.collect());
}

/// No level alone is worth it, but all together are.
TEST(ForgottenHistory, LetsCellsMoveWhereWaitingForOneProcessAddsUp) {
    AdaptiveMesh mesh = shared_out(test::kuhn(2, 2, 2, 1.0 / 2), "block");
    int moves = 0;
    for (const Selection& selection : to_a_corner()) {
        const auto done = mesh.refine_evenly(
            selection,
            {.most_over_mean = 1.1, .only_if_it_pays = true, .may_forget_history = true});
        moves += done.move.changed() ? 1 : 0;
    }
    EXPECT_LE(most_over_mean(mesh), 2.2);
    EXPECT_GE(moves, std::min(2, test::world().size() / 2));
    EXPECT_LE(moves, 10);
}

/// Marks of all cells, again and again, end in the mesh whose cells are the roots.
TEST(ForgottenHistory, IsWhereCoarseningEnds) {
    AdaptiveMesh mesh = shared_out(input_of(1), "block");
    Mesh last = mesh.collect();  // before it was forgotten
    for (std::uint64_t k = 0; k < 6; ++k) {
        const Mesh before = mesh.collect();
        const std::uint64_t roots = test::world().sum(mesh.roots().size());
        (void)mesh.refine_evenly(some(0.05, k), forgetting);
        if (test::world().sum(mesh.roots().size()) != roots) last = before;
    }
    for (Adaptation step = mesh.coarsen(Selection{.all = true}); step.changed;) {
        step = mesh.coarsen(Selection{.all = true});
    }
    EXPECT_TRUE(mesh.collect() == last);
}

/// It is taken back where the step is refused.
TEST(ForgottenHistory, IsThereStillAfterAStepThatIsRefused) {
    Mesh whole = test::kuhn(3, 3, 3, 8);
    for (Point& p : whole.points) p = {p.x + 0x1p52, p.y + 0x1p52, p.z + 0x1p52};
    const Selection corner{
        .boxes = {{{0x1p52, 0x1p52, 0x1p52}, {0x1p52 + 9, 0x1p52 + 9, 0x1p52 + 9}}}};
    AdaptiveMesh mesh = shared_out(whole, "block");
    bool is_refused = false;
    for (int k = 0; k < 6 && !is_refused; ++k) {
        const test::SeenMesh before(mesh);
        const std::vector<std::uint64_t> roots(mesh.roots().begin(), mesh.roots().end());
        try {
            if (k < 2) (void)mesh.refine(corner);
            if (k >= 2) (void)mesh.refine_evenly(corner, forgetting);
        } catch (const InputError&) {
            EXPECT_TRUE(before == test::SeenMesh(mesh));
            EXPECT_TRUE(std::ranges::equal(roots, mesh.roots()));
            is_refused = true;
        }
    }
    EXPECT_TRUE(is_refused);
}

}  // namespace
}  // namespace octetra::distributed
