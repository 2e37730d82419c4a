#include <array>
#include <cstdlib>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/reference/refine.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/world.hpp"
#include "level/tuning.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

/// Each rank makes a level as a full sweep, with all edges or the local edge set numbered, or
/// incrementally. The result always equals the reference's, and the work of an incremental level is
/// proportional to the number of changed cells.
namespace octetra::distributed {
namespace {

constexpr double always = 10;

/// The kind of level of each rank; `local_sweep` is a full sweep with a local edge set.
enum class Kinds { full_sweep, local_sweep, incremental, alternating, alternating_shifted };

Tuning tuning_of(Kinds kinds, int level) {
    if (kinds == Kinds::alternating || kinds == Kinds::alternating_shifted) {
        const int turn = test::world().rank() + level + (kinds == Kinds::alternating ? 0 : 1);
        constexpr std::array turns{Kinds::incremental, Kinds::local_sweep, Kinds::incremental,
                                   Kinds::full_sweep};
        kinds = turns[static_cast<std::size_t>(turn) % turns.size()];
    }
    return {.incremental_below = kinds == Kinds::incremental ? always : 0,
            .local_below = kinds == Kinds::local_sweep ? always : 0};
}

DistributedMesh distributed_mesh(const Mesh& mesh, const Partition& partition) {
    return distribute(test::world(), mesh, partition_cells(mesh, test::world().size(), partition));
}

const std::vector<Partition> few_partitions{
    {.method = PartitionMethod::lepp},
    {.method = PartitionMethod::block},
    {.method = PartitionMethod::random, .seed = 1},
};

/// With one rank all partitions are the same; under sanitizers one partition with borders
/// everywhere suffices.
std::vector<Partition> few_partitions_that_differ() {
    if (test::world().size() == 1) return {few_partitions.front()};
    if (OCTETRA_SANITIZED) return {few_partitions.back()};
    return few_partitions;
}

class LevelKinds : public testing::TestWithParam<std::tuple<Scheme, Synchronisation, Kinds>> {
protected:
    const Scheme scheme = std::get<0>(GetParam());
    const Synchronisation synchronisation = std::get<1>(GetParam());
    const Kinds kinds = std::get<2>(GetParam());

    void expect_equal(const Mesh& mesh, const std::vector<Selection>& selections) const {
        for (const Selection& selection : selections) {
            const auto expected = test::world().is_first()
                                      ? reference::refine(mesh, selection, scheme, 3)
                                      : reference::Refinement{};
            for (const Partition& partition : few_partitions_that_differ()) {
                DistributedMesh part = distributed_mesh(mesh, partition);
                (void)refine(part, selection, {scheme, 3, synchronisation}, tuning_of(kinds, 0));
                const Collected whole = collect(std::move(part));
                if (!test::world().is_first()) continue;
                EXPECT_TRUE(whole.mesh == expected.mesh);
                EXPECT_TRUE(whole.maps == expected.maps);
            }
        }
    }
};

TEST_P(LevelKinds, GiveTheSameOnAShakenLatticeWithEverythingMarked) {
    expect_equal(test::marked(test::perturbed_kuhn(3, 0.3, 5), 1),
                 {{.random = RandomShare{0.1, 3}},
                  {.spheres = {{{1, 1, 1}, 0.6}}},
                  {.regions = {2}, .max_volume = 0.1}});
}

TEST_P(LevelKinds, GiveTheSameOnALatticeFullOfTies) {
    expect_equal(test::marked(test::kuhn(3, 2, 2), 2),
                 {{.boxes = {{{0, 0, 0}, {1, 1, 2}}}}, {.cells = {GlobalCell{0}, GlobalCell{40}}}});
}

TEST_P(LevelKinds, GiveTheSameOnCoordinatesThatRound) {
    Mesh mesh = test::kuhn(2, 2, 3, 1.0 / 3);
    for (Point& p : mesh.points) p = {p.x / 7 + 1, p.y * 0.3, p.z * 1e-3};
    expect_equal(mesh, {{.random = RandomShare{0.2, 3}}, {.max_volume = 2e-7}});
}

TEST_P(LevelKinds, FollowPathsThatGoThroughAllCells) {
    const Mesh shell = test::shell(200, 1);
    expect_equal(shell, {{.cells = {GlobalCell{0}}}});
    if (!test::world().is_first()) return;
    const auto fine = reference::refine(shell, {.cells = {GlobalCell{0}}}, Scheme::eight, 1).mesh;
    EXPECT_GT(fine.cells.size(), 2 * shell.cells.size()) << "none was spared";
}

TEST_P(LevelKinds, MayChangeFromLevelToLevelAndSoMayTheSelection) {
    const char* const given = std::getenv("OCTETRA_WAYS_SEED");
    const unsigned seed = given != nullptr ? static_cast<unsigned>(std::atoi(given)) : 1;
    SCOPED_TRACE("OCTETRA_WAYS_SEED=" + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> coordinate(-0.5, 4.5);
    const auto point = [&] {
        return Point{coordinate(random), coordinate(random), coordinate(random)};
    };
    for (int run = 0; run < 4; ++run) {
        Mesh expected = test::marked(test::perturbed_kuhn(4, 0.3, 5), 1);
        DistributedMesh part = distributed_mesh(
            expected, few_partitions[static_cast<std::size_t>(run) % few_partitions.size()]);
        for (int level = 0; level < 5; ++level) {
            Selection selection;
            selection.spheres.push_back({point(), 1 / (1.0 + level)});
            const Point low = point();
            selection.boxes.push_back({low, {low.x + 0.5, low.y + 0.5, low.z + 0.5}});
            (void)refine(part, selection, {scheme, 1, synchronisation},
                         tuning_of(kinds, level / 2));
            expected = reference::refine(expected, selection, scheme, 1).mesh;
        }
        const Collected whole = collect(std::move(part));
        if (!test::world().is_first()) continue;
        EXPECT_TRUE(whole.mesh == expected);
    }
}

TEST_P(LevelKinds, RefuseRoundingWithTheSameMessage) {
    Mesh mesh = test::kuhn(2, 2, 2);
    for (Point& p : mesh.points) p = {p.x * 2 + 0x1p52, p.y, p.z};
    const Selection selection{.random = RandomShare{0.5, 2}};
    const std::string expected =
        test::thrown_by<InputError>([&] { (void)reference::refine(mesh, selection, scheme, 6); });
    for (const Partition& partition : few_partitions_that_differ()) {
        DistributedMesh part = distributed_mesh(mesh, partition);
        EXPECT_EQ(
            test::thrown_by<InputError>([&] {
                (void)refine(part, selection, {scheme, 6, synchronisation}, tuning_of(kinds, 0));
            }),
            expected);
    }
}

INSTANTIATE_TEST_SUITE_P(
    SchemesSynchronisationsKinds, LevelKinds,
    testing::Combine(testing::Values(Scheme::eight, Scheme::four, Scheme::two),
                     testing::Values(Synchronisation::neighbour, Synchronisation::gateway),
                     testing::Values(Kinds::full_sweep, Kinds::local_sweep, Kinds::incremental,
                                     Kinds::alternating, Kinds::alternating_shifted)));

struct Work {
    std::uint64_t cells = 0;    ///< of all ranks, after the level
    std::uint64_t touched = 0;  ///< by all ranks
    friend bool operator==(const Work&, const Work&) = default;
};

/// Collective. The work of each level of a run, on the first rank.
std::vector<Work> work_of(DistributedMesh& mesh, const Selection& selection, int levels,
                          const Tuning& tuning = {}) {
    mesh.processes = profiled(test::world(), ProfileDetail::sums);
    (void)refine(mesh, selection, {.levels = levels}, tuning);
    std::vector<Work> work;
    for (const ProfiledLevel& level : gather_profile(mesh.processes).levels) {
        const auto sum = [](const std::vector<std::uint64_t>& of_rank) {
            return std::accumulate(of_rank.begin(), of_rank.end(), std::uint64_t{0});
        };
        work.push_back({sum(level.cells_of_rank), sum(level.cells_touched_of_rank)});
    }
    mesh.processes = test::world();
    return work;
}

Selection around_the_middle(std::size_t n, double radius) {
    const auto middle = static_cast<double>(n) / 2;
    return {.spheres = {{{middle, middle, middle}, radius}}};
}

TEST(IncrementalLevel, OfALaterLevelDoesNotSeeHowLargeTheMeshIs) {
    std::vector<std::vector<std::uint64_t>> touched;
    for (const std::size_t n : {8U, 16U}) {
        DistributedMesh mesh = distributed_mesh(test::kuhn(n, n, n), few_partitions[1]);
        const auto work =
            work_of(mesh, around_the_middle(n, 0.8), 3, {.incremental_below = always});
        if (!test::world().is_first()) continue;
        ASSERT_EQ(work.size(), 4U);
        for (const std::size_t level : {2U, 3U}) {
            EXPECT_GT(work[level].cells, work[level - 1].cells);
            EXPECT_LT(work[level].touched, 2 * (work[level].cells - work[level - 1].cells));
        }
        touched.push_back({work[2].touched, work[3].touched});
    }
    if (!test::world().is_first()) return;
    EXPECT_EQ(touched[0], touched[1]);
}

TEST(IncrementalLevel, IsTakenWhereFewCellsAreMarkedByAnotherSelectionEachTime) {
    const std::size_t n = 24;
    DistributedMesh mesh = distributed_mesh(test::kuhn(n, n, n), few_partitions[1]);
    for (int level = 1; level <= 6; ++level) {
        const auto cells = test::world().sum(mesh.cells.size());
        const auto work = work_of(mesh, around_the_middle(n, 2.0 / (1 << level)), 1);
        if (!test::world().is_first()) continue;
        ASSERT_EQ(work.size(), 2U);
        EXPECT_GT(work[1].cells, cells);
        // The first level must judge all cells.
        EXPECT_LT(work[1].touched, level == 1 ? cells * 11 / 10 : cells / 10) << "level " << level;
    }
}

TEST(IncrementalLevel, IsTakenForALastLevelOnlyWhereEarlierOnesHavePreparedIt) {
    const std::size_t n = 16;
    const Selection selection = around_the_middle(n, 0.8);
    const auto refined = [&](int levels, bool is_last) {
        DistributedMesh mesh = distributed_mesh(test::kuhn(n, n, n), few_partitions[1]);
        (void)refine(mesh, selection, {.levels = levels, .is_last = is_last});
        return mesh;
    };
    DistributedMesh once = refined(1, false);
    DistributedMesh only_once = refined(1, true);
    EXPECT_TRUE(once.adjacency != nullptr);
    EXPECT_TRUE(only_once.adjacency == nullptr);
    DistributedMesh twice = refined(2, true);
    EXPECT_TRUE(twice.adjacency != nullptr);
    (void)refine(once, selection, {.levels = 1, .is_last = true});
    EXPECT_TRUE(once.adjacency != nullptr) << "the existing one is used";
    (void)refine(only_once, selection, {.levels = 1, .is_last = true});
    const Mesh expected = collect(std::move(twice)).mesh;
    EXPECT_TRUE(collect(std::move(once)).mesh == expected);
    EXPECT_TRUE(collect(std::move(only_once)).mesh == expected);
}

TEST(IncrementalLevel, IsNotTakenWhereManyCellsAreMarkedOrFewEverywhere) {
    for (const Selection& selection : {Selection{.all = true}, around_the_middle(8, 4),
                                       Selection{.random = RandomShare{0.05, 3}}}) {
        DistributedMesh mesh = distributed_mesh(test::kuhn(8, 8, 8), few_partitions[1]);
        const std::uint64_t cells = test::world().sum(mesh.cells.size());
        const auto work = work_of(mesh, selection, 2);
        if (!test::world().is_first()) continue;
        // Every cell was judged and, unless all are marked, processed again by a full sweep.
        const std::uint64_t times = selection.all ? 1 : 2;
        EXPECT_EQ(work[1].touched, times * cells);
        EXPECT_EQ(work[2].touched, times * work[1].cells);
    }
}

}  // namespace
}  // namespace octetra::distributed
