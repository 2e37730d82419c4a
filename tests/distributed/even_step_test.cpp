#include <array>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/reference/history.hpp>
#include <octetra/reference/refine.hpp>

#include "distributed/moving_mesh.hpp"
#include "distributed/observed_mesh.hpp"
#include "distributed/shared_folder.hpp"
#include "support/refinement.hpp"
#include "support/thrown.hpp"

/// Tests of migration between closure and bisection.
namespace octetra::distributed {
namespace {

/// Migrates for the least improvement of the balance.
constexpr BalanceOptions always{.most_over_mean = 1};

class EvenSteps : public testing::TestWithParam<std::uint64_t> {};

TEST_P(EvenSteps, ChangeNoStepAndNoFile) {
    std::mt19937_64 random(GetParam());
    MovingAndResting pair(GetParam());
    for (int k = 0; k < 7; ++k) {
        constexpr std::array<double, 4> shares{0.001, 0.004, 0.05, 0.9};
        const bool refines = k == 0 || random() % 4 != 0;
        const Selection selection = some(shares[random() % (refines ? 3 : 4)], random());
        if (refines) {
            (void)pair.moving.refine_evenly(selection, always);
            (void)pair.resting.refine(selection);
        } else {
            (void)pair.moving.coarsen(selection);
            (void)pair.resting.coarsen(selection);
        }
        SCOPED_TRACE(k);
        pair.expect_step(selection, refines);
        ASSERT_FALSE(HasFailure());
    }
    pair.expect_same_checkpoints();
}

TEST_P(EvenSteps, OfManyLevelsAreThoseOfTheReference) {
    const Mesh input = input_of(GetParam());
    const auto parts = partition_cells(input, test::world().size(), parse_partition("block"));
    for (const Selection& selection :
         {some(0.01, GetParam()), Selection{.boxes = {{{0, 0, 0}, {1.2, 1.2, 1.2}}}},
          Selection{.all = true}}) {
        for (const Scheme scheme : {Scheme::eight, Scheme::two}) {
            DistributedMesh mesh = distribute(test::world(), input, parts);
            refine(mesh, selection, {.scheme = scheme, .levels = 3, .balance = always});
            const Collected found = collect(std::move(mesh));
            if (!test::world().is_first()) continue;
            const auto expected = reference::refine(input, selection, scheme, 3);
            EXPECT_TRUE(found.mesh == expected.mesh);
            EXPECT_TRUE(found.maps == expected.maps);
        }
    }
}

/// Values on cells and vertices are transferred by the migration and then by the step.
TEST_P(EvenSteps, TransferValues) {
    std::mt19937_64 random(GetParam());
    AdaptiveMesh mesh = distributed_mesh(input_of(GetParam()), "block");
    const auto roots_of_cells = [&] {
        std::vector<std::uint64_t> roots;
        for (const std::uint32_t r : mesh.root_of_cells()) roots.push_back(mesh.roots()[r]);
        return roots;
    };
    for (int k = 0; k < 5; ++k) {
        std::vector<double> places;
        for (const Point& p : mesh.points()) places.insert(places.end(), {p.x, p.y, p.z});
        std::vector<std::uint64_t> roots = roots_of_cells();
        const auto marks = [&] {
            std::vector<std::uint8_t> bytes(mesh.cells().size(), 0);
            for (std::uint8_t& byte : bytes) byte = random() % (k % 2 == 0 ? 20 : 300) == 0;
            return bytes;
        }();
        const auto [move, step] = mesh.refine_evenly(std::span<const std::uint8_t>(marks), always);
        places = step.transfer_vertices(move.vertices(std::move(places), 3), 3);
        roots = step.transfer_cells(move.cells(std::move(roots)));
        std::vector<double> expected;
        for (const Point& p : mesh.points()) expected.insert(expected.end(), {p.x, p.y, p.z});
        EXPECT_TRUE(places == expected) << k;
        EXPECT_TRUE(roots == roots_of_cells()) << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, EvenSteps, testing::Range<std::uint64_t>(0, 6));

constexpr Sphere ball{{1, 1, 1}, 2.0};

TEST(EvenStep, LeavesProcessesEvenThatWouldNotBe) {
    AdaptiveMesh evenly = distributed_mesh(test::perturbed_kuhn(10, 0.2, 1), "block");
    AdaptiveMesh plainly = distributed_mesh(test::perturbed_kuhn(10, 0.2, 1), "block");
    for (int k = 0; k < 3; ++k) {
        const auto done = evenly.refine_evenly({.spheres = {ball}}, {.most_over_mean = 1.1});
        const Adaptation plain = plainly.refine({.spheres = {ball}});
        EXPECT_LE(most_over_mean(evenly), 1.1);
        if (k > 0) continue;
        EXPECT_EQ(done.move.changed(), test::world().size() > 1);
        EXPECT_EQ(done.step.synchronisation.rounds, plain.synchronisation.rounds);
    }
    EXPECT_TRUE(test::world().size() == 1 || most_over_mean(plainly) > 1.3);
}

TEST(EvenStep, MovesWhereItPaysOnly) {
    const BalanceOptions paying{.most_over_mean = 1.1, .only_if_it_pays = true};
    AdaptiveMesh mesh = distributed_mesh(test::perturbed_kuhn(10, 0.2, 1), "block");
    // A slight imbalance does not justify migrating many cells.
    EXPECT_FALSE(mesh.refine_evenly({.spheres = {{{1, 1, 1}, 1.0}}}, paying).move.changed());
    // One process would get eight times its cells, and the others none.
    const auto all_here = static_cast<std::uint64_t>(test::world().is_first() ? 1 : 0);
    std::vector<std::uint8_t> marks(mesh.cells().size(), all_here != 0 ? 1 : 0);
    const auto done = mesh.refine_evenly(std::span<const std::uint8_t>(marks), paying);
    EXPECT_EQ(done.move.changed(), test::world().size() > 1);
    EXPECT_LE(most_over_mean(mesh), 1.1);
}

/// If a single root dominates, no partition is better, and the level that was undone is repeated.
TEST(EvenStep, ThatNoOtherSharesHelpIsAPlainOne) {
    const Selection corner{.spheres = {{{3, 0, 0}, 0.8}}};
    AdaptiveMesh evenly = distributed_mesh(test::perturbed_kuhn(3, 0.2, 1), "block");
    AdaptiveMesh plainly = distributed_mesh(test::perturbed_kuhn(3, 0.2, 1), "block");
    int undone = 0;
    for (std::uint64_t k = 0; k < 12; ++k) {
        const Selection selection = k < 5 ? corner : some(0.0002, k);
        const auto done = evenly.refine_evenly(selection, always);
        (void)plainly.refine(selection);
        const Mesh found = evenly.collect();
        EXPECT_TRUE(found == plainly.collect()) << k;
        if (!done.move.changed() && most_over_mean(evenly) > 1.01) ++undone;
    }
    EXPECT_TRUE(test::world().size() == 1 || undone > 0);
}

TEST(EvenStep, ThatIsRefusedLeavesTheMeshAsItWas) {
    // At this distance only whole numbers are representable: after some levels an edge has no
    // midpoint.
    Mesh whole = test::kuhn(3, 3, 3, 8);
    for (Point& p : whole.points) p = {p.x + 0x1p52, p.y + 0x1p52, p.z + 0x1p52};
    const Selection corner{
        .boxes = {{{0x1p52, 0x1p52, 0x1p52}, {0x1p52 + 9, 0x1p52 + 9, 0x1p52 + 9}}}};
    const bool is_last = test::world().rank() == test::world().size() - 1;
    for (const bool lean : {false, true}) {
        AdaptiveMesh mesh = distributed_mesh(whole, "block");
        bool is_refused = false;
        for (int k = 0; k < 6 && !is_refused; ++k) {
            const test::ObservedMesh before(mesh);
            EXPECT_THROW((void)mesh.refine_evenly(corner, always, {.max_cells = 10}), InputError);
            EXPECT_THROW((void)mesh.refine_evenly(corner, {.most_over_mean = 0.9}), InputError);
            if (test::world().size() > 1) {
                EXPECT_THROW((void)mesh.refine_evenly(corner, {.only_if_it_pays = is_last}),
                             InputError);
            }
            EXPECT_TRUE(before == test::ObservedMesh(mesh));
            try {
                if (lean) (void)mesh.refine(corner);
                if (!lean) (void)mesh.refine_evenly(corner, always);
            } catch (const InputError& error) {
                EXPECT_THAT(error.what(), testing::HasSubstr("midpoints"));
                EXPECT_TRUE(before == test::ObservedMesh(mesh));
                EXPECT_THROW((void)mesh.refine_evenly(corner, always), InputError);
                EXPECT_TRUE(before == test::ObservedMesh(mesh));
                is_refused = true;
            }
        }
        EXPECT_TRUE(is_refused);
    }
}

TEST(EvenStep, OfAPlainMeshThatIsRefusedLeavesItAsItWas) {
    Mesh whole = test::kuhn(3, 3, 3, 8);
    for (Point& p : whole.points) p = {p.x + 0x1p52, p.y + 0x1p52, p.z + 0x1p52};
    const Selection corner{
        .boxes = {{{0x1p52, 0x1p52, 0x1p52}, {0x1p52 + 9, 0x1p52 + 9, 0x1p52 + 9}}}};
    const auto parts = partition_cells(whole, test::world().size(), parse_partition("block"));
    DistributedMesh mesh = distribute(test::world(), whole, parts);
    int levels = 0;
    const auto words = test::thrown_by<InputError>([&] {
        refine(mesh, corner, {.levels = 9, .balance = always, .on_level = [&](int level, auto) {
                                  levels = level;
                              }});
    });
    EXPECT_THAT(words, testing::HasSubstr("midpoints"));
    const std::vector<int> of_first{levels};
    levels = test::of_all(of_first).front().front();
    ASSERT_GE(levels, 1);
    const Mesh found = collect(std::move(mesh)).mesh;
    if (!test::world().is_first()) return;
    EXPECT_TRUE(found == reference::refine(whole, corner, Scheme::eight, levels).mesh);
}

}  // namespace
}  // namespace octetra::distributed
