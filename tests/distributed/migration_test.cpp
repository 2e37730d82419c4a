#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/orientation.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/exchange.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/reference/history.hpp>

#include "distributed/moving_mesh.hpp"
#include "distributed/observed_mesh.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/refinement.hpp"

/// Tests of AdaptiveMesh::migrate and rebalance, and of the values that they transfer.
namespace octetra::distributed {
namespace {

using test::world;

/// Target ranks of roots, the same on all processes: random among the first ranks, or in sequence.
struct Targets {
    std::uint64_t seed = 0;
    int ranks = 1;

    [[nodiscard]] int of(std::uint64_t root) const {
        std::mt19937_64 random(root * 1000003 + seed);
        return static_cast<int>(random() % static_cast<std::uint64_t>(ranks));
    }
    [[nodiscard]] std::vector<int> of(std::span<const std::uint64_t> roots) const {
        std::vector<int> ranks_of;
        for (const std::uint64_t root : roots) ranks_of.push_back(of(root));
        return ranks_of;
    }
};

/// Some of these leave ranks without roots.
Targets random_targets(std::mt19937_64& random) {
    const auto all = static_cast<std::uint64_t>(world().size());
    return {random(), random() % 2 == 0 ? world().size() : static_cast<int>(random() % all) + 1};
}

class MigratingMesh : public testing::TestWithParam<std::uint64_t> {};

TEST_P(MigratingMesh, ToAnywhereBeforeEveryStepChangesNoStepAndNoFile) {
    std::mt19937_64 random(GetParam());
    MovingAndResting pair(GetParam());
    AdaptiveMesh& moving = pair.moving;
    for (int k = 0; k < 7; ++k) {
        (void)moving.migrate(random_targets(random).of(moving.roots()));
        constexpr std::array<double, 3> shares{0.002, 0.05, 0.9};
        const bool refines = k == 0 || random() % 3 != 0;
        const Selection selection = some(shares[random() % (refines ? 2 : 3)], random());
        for (AdaptiveMesh* mesh : {&moving, &pair.resting}) {
            (void)(refines ? mesh->refine(selection) : mesh->coarsen(selection));
        }
        SCOPED_TRACE(k);
        pair.expect_step(selection, refines);
        ASSERT_FALSE(HasFailure());
    }
    (void)moving.migrate(random_targets(random).of(moving.roots()));
    pair.expect_same_checkpoints();
}

std::vector<CellVertices> sorted(std::vector<CellVertices> cells) {
    std::ranges::sort(cells);
    return cells;
}

/// Compares the sharers of each vertex. The order of the lists for exchange may differ.
void expect_same_sharers(const Sharing<VertexIndex>& a, const Sharing<VertexIndex>& b) {
    EXPECT_EQ(a.shared(), b.shared());
    for (const VertexIndex v : a.shared()) {
        EXPECT_TRUE(std::ranges::equal(a.sharers(v), b.sharers(v)));
        EXPECT_EQ(a.owner(v), b.owner(v));
    }
    ASSERT_EQ(a.neighbours().size(), b.neighbours().size());
    for (std::size_t n = 0; n < a.neighbours().size(); ++n) {
        EXPECT_EQ(a.neighbours()[n].rank, b.neighbours()[n].rank);
        EXPECT_TRUE(
            std::ranges::is_permutation(a.neighbours()[n].entities, b.neighbours()[n].entities));
        EXPECT_TRUE(std::ranges::is_permutation(a.neighbours()[n].owned, b.neighbours()[n].owned));
    }
}

TEST_P(MigratingMesh, IsAsIfItsCellsHadBeenThereFromTheBeginning) {
    std::mt19937_64 random(GetParam());
    const Mesh input = input_of(GetParam());
    const Targets targets = random_targets(random);
    std::vector<int> parts;
    for (std::uint64_t c = 0; c < input.cells.size(); ++c) parts.push_back(targets.of(c));
    AdaptiveMesh moved = distributed_mesh(input, "random:1");
    AdaptiveMesh there = AdaptiveMesh::distribute(world(), input, parts);
    for (AdaptiveMesh* mesh : {&moved, &there}) {
        for (const std::uint64_t k : {0U, 1U, 2U, 3U}) {
            (void)mesh->refine(some(k == 2 ? 0.3 : 0.004, GetParam() + k));
        }
        (void)mesh->coarsen(some(0.8, GetParam()));
    }
    EXPECT_EQ(moved.migrate(targets.of(moved.roots())).changed(), world().size() > 1);
    const test::ObservedMesh a(moved);
    const test::ObservedMesh b(there);
    EXPECT_EQ(std::ranges::equal(moved.roots(), there.roots()), true);
    EXPECT_EQ(sorted(a.cells), sorted(b.cells));
    // The vertex of no cell has not moved.
    const auto has_lone = [](const test::ObservedMesh& seen) {
        return std::ranges::find(seen.points, Point{9, 9, 9}) != seen.points.end();
    };
    if (has_lone(a) == has_lone(b)) {
        EXPECT_EQ(a.points, b.points);
        EXPECT_EQ(a.numbers, b.numbers);
        expect_same_sharers(a.sharing, b.sharing);
    }
    EXPECT_EQ(a.whole == b.whole, true);
    // The lists on both sides of an interface correspond.
    std::vector<Point> points = a.points;
    for (const VertexIndex v : a.sharing.shared()) {
        if (!a.sharing.is_owned(v)) points[v.value()] = {};
    }
    update_copies(world(), a.sharing, points.size(), points);
    EXPECT_EQ(points, a.points);
    // The root of a cell is its ancestor.
    const auto roots_of = moved.root_of_cells();
    std::vector<std::uint32_t> count(moved.roots().size(), 0);
    for (const std::uint32_t r : roots_of) ++count[r];
    EXPECT_EQ(std::ranges::count(count, 0U), 0);
}

/// Values that identify the cell or vertex that they belong to.
struct IdentifyingValues {
    std::vector<Point> corners_of_cells;  ///< four for each cell
    std::vector<Point> of_vertices;
    ValueLists<std::uint64_t> lists_of_cells;
    ValueLists<std::uint8_t> lists_of_vertices;

    explicit IdentifyingValues(const AdaptiveMesh& mesh) {
        const auto number = [&](VertexIndex v) {
            return static_cast<std::uint64_t>(mesh.vertex_numbers()[v.value()]);
        };
        of_vertices.assign(mesh.points().begin(), mesh.points().end());
        for (const CellVertices& cell : mesh.cells()) {
            for (const VertexIndex v : cell) {
                corners_of_cells.push_back(mesh.points()[v.value()]);
                if (number(v) % 3 != 0) lists_of_cells.values.push_back(number(v));
            }
            lists_of_cells.begin.push_back(lists_of_cells.values.size());
        }
        for (VertexIndex v{0}; v.value() < mesh.points().size(); ++v) {
            lists_of_vertices.values.insert(lists_of_vertices.values.end(), number(v) % 5,
                                            static_cast<std::uint8_t>(number(v)));
            lists_of_vertices.begin.push_back(lists_of_vertices.values.size());
        }
    }
    friend bool operator==(const IdentifyingValues&, const IdentifyingValues&) = default;
};

TEST_P(MigratingMesh, TransfersTheValuesOfCellsAndVertices) {
    std::mt19937_64 random(GetParam());
    AdaptiveMesh mesh = distributed_mesh(input_of(GetParam()), "random:1");
    for (int k = 0; k < 6; ++k) {
        (void)mesh.refine(some(k % 2 == 0 ? 0.02 : 0.002, random()));
        IdentifyingValues migrated(mesh);
        const Migration migration = mesh.migrate(random_targets(random).of(mesh.roots()));
        migrated.corners_of_cells = migration.cells(std::move(migrated.corners_of_cells), 4);
        migrated.of_vertices = migration.vertices(std::move(migrated.of_vertices));
        migrated.lists_of_cells = migration.cells(std::move(migrated.lists_of_cells));
        migrated.lists_of_vertices = migration.vertices(std::move(migrated.lists_of_vertices));
        EXPECT_EQ(migrated == IdentifyingValues(mesh), true);
        EXPECT_TRUE(migration.cells(std::vector<double>(), 0).empty());
    }
}

TEST_P(MigratingMesh, RefusesValuesThatDoNotFitItOnAllProcesses) {
    std::mt19937_64 random(GetParam());
    AdaptiveMesh mesh = distributed_mesh(input_of(GetParam()), "random:1");
    (void)mesh.refine(some(0.1, GetParam()));
    const std::vector<int> targets = random_targets(random).of(mesh.roots());
    const std::vector<int> here(mesh.roots().size(), world().rank());
    for (const std::vector<int>& ranks : {here, targets}) {  // also if nothing moves
        const std::size_t count = mesh.cells().size() + (world().is_first() ? 1 : 0);
        const Migration migration = mesh.migrate(ranks);
        EXPECT_THROW((void)migration.cells(std::vector<double>(count)), InputError);
        EXPECT_THROW((void)migration.cells(std::vector<double>(2 * count - 1), 2), InputError);
        ValueLists<int> lists;
        lists.begin.assign(count + 1, 0);
        EXPECT_THROW((void)migration.cells(lists), InputError);
        EXPECT_THROW((void)migration.cells(std::vector<double>(1), 0), InputError);
        EXPECT_TRUE(migration.cells(std::vector<double>(), 0).empty());
    }
}

TEST_P(MigratingMesh, RefusesValuesOfAnotherSizeOnOneProcess) {
    if (world().size() == 1) GTEST_SKIP() << "one process has no other to differ from";
    std::mt19937_64 random(GetParam());
    AdaptiveMesh mesh = distributed_mesh(input_of(GetParam()), "random:1");
    (void)mesh.refine(some(0.1, GetParam()));
    const std::vector<int> targets = random_targets(random).of(mesh.roots());
    const std::vector<int> here(mesh.roots().size(), world().rank());
    const bool is_odd = world().rank() == world().size() - 1;
    for (const std::vector<int>& ranks : {here, targets}) {  // also if nothing moves
        const std::size_t count = mesh.cells().size();
        const Migration migration = mesh.migrate(ranks);
        const std::size_t components = is_odd ? 2 : 3;
        EXPECT_THROW(
            (void)migration.cells(std::vector<double>(components * count, 1.0), components),
            InputError);
        ValueLists<int> integers;
        integers.begin.assign(count + 1, 0);
        ValueLists<double> reals;
        reals.begin.assign(count + 1, 0);
        if (is_odd) {
            EXPECT_THROW((void)migration.cells(integers), InputError);
        } else {
            EXPECT_THROW((void)migration.cells(reals), InputError);
        }
        const auto well = migration.cells(std::vector<double>(count, 1.0));
        EXPECT_EQ(well, std::vector<double>(mesh.cells().size(), 1.0));
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, MigratingMesh, testing::Range<std::uint64_t>(0, 6));

TEST(MigratingToInvalidRanks, IsRefusedOnAllProcessesAndChangesNothing) {
    AdaptiveMesh mesh = distributed_mesh(input_of(1), "block");
    (void)mesh.refine(some(0.1, 1));
    const test::ObservedMesh before(mesh);
    std::vector<int> ranks(mesh.roots().size(), 0);
    if (!ranks.empty() && world().rank() == world().size() - 1) ranks.back() = world().size();
    EXPECT_THROW((void)mesh.migrate(ranks), InputError);
    ranks.assign(mesh.roots().size() + (world().is_first() ? 1 : 0), 0);
    EXPECT_THROW((void)mesh.migrate(ranks), InputError);
    if (world().size() > 1) {
        const double limit = world().is_first() ? 1.5 : 1.2;
        EXPECT_THROW((void)mesh.rebalance({.most_over_mean = limit}), InputError);
    }
    EXPECT_THROW((void)mesh.rebalance({.most_over_mean = 0.5}), InputError);
    EXPECT_TRUE(before == test::ObservedMesh(mesh));
}

TEST(DistributingMesh, RefusesWhatIsNotARankForEachCell) {
    if (world().size() == 1) return;  // a single process keeps the mesh as it is
    const Mesh mesh = input_of(1);
    const auto refused = [&](std::size_t count, int last) {
        std::vector<int> ranks(count, 0);
        ranks.back() = last;
        EXPECT_THROW((void)AdaptiveMesh::distribute(world(), mesh, ranks), InputError);
    };
    refused(mesh.cells.size(), world().size());
    refused(mesh.cells.size(), -1);
    refused(mesh.cells.size() - 1, 0);
    refused(mesh.cells.size() + 1, 0);
}

TEST(RebalancingMesh, WithABallRefinedIsEvenAndNotMovedAgain) {
    AdaptiveMesh mesh = distributed_mesh(test::perturbed_kuhn(8, 0.2, 1), "block");
    for (int k = 0; k < 3; ++k) (void)mesh.refine({.spheres = {{{1, 1, 1}, 2.0}}});
    const Mesh before = mesh.collect();
    const double uneven = most_over_mean(mesh);
    EXPECT_EQ(mesh.rebalance().changed(), world().size() > 1);
    EXPECT_LE(most_over_mean(mesh), 1.1);
    EXPECT_TRUE(world().size() == 1 || uneven > 1.3);
    EXPECT_TRUE(mesh.collect() == before);
    EXPECT_FALSE(mesh.rebalance().changed());
}

/// A few roots with many levels each are partitioned badly by coordinates alone.
TEST(RebalancingMesh, OfFewHeavyRootsIsEvenWhereTheyLetIt) {
    AdaptiveMesh mesh = distributed_mesh(test::perturbed_kuhn(2, 0.2, 1), "block");
    for (int k = 0; k < 4; ++k) (void)mesh.refine({.spheres = {{{1, 1, 1}, 0.9}}});
    const Mesh before = mesh.collect();
    (void)mesh.rebalance({.most_over_mean = 1.02});
    EXPECT_LE(most_over_mean(mesh), 1.02);
    EXPECT_TRUE(mesh.collect() == before);
}

TEST(RebalancingMesh, LeavesMostCellsWhereTheyAre) {
    AdaptiveMesh mesh = distributed_mesh(test::perturbed_kuhn(8, 0.2, 1), "block");
    (void)mesh.refine({.spheres = {{{1, 1, 1}, 3.0}}});
    (void)mesh.rebalance({.most_over_mean = 1});
    (void)mesh.refine({.spheres = {{{1, 1, 1}, 3.0}}});
    std::vector<int> ranks(mesh.cells().size(), world().rank());
    ranks = mesh.rebalance({.most_over_mean = 1}).cells(std::move(ranks));
    const auto stayed = static_cast<std::uint64_t>(std::ranges::count(ranks, world().rank()));
    EXPECT_GE(static_cast<double>(world().sum(stayed)),
              0.6 * static_cast<double>(world().sum(mesh.cells().size())));
}

TEST(RebalancingMesh, DoesNothingWhereNothingMendsIt) {
    AdaptiveMesh mesh =
        distributed_mesh(test::one_cell({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}), "block");
    (void)mesh.refine({.all = true});
    EXPECT_FALSE(mesh.rebalance().changed());
    EXPECT_EQ(world().sum(mesh.cells().size()), 8U);
}

}  // namespace
}  // namespace octetra::distributed
