#include <limits>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/reference/refine.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/world.hpp"
#include "level/tuning.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

/// Compares the distributed engine with the reference: identical meshes, numbering and maps.
namespace octetra::distributed {
namespace {

using test::marked;
using testing::HasSubstr;

Collected refined(const Mesh& mesh, const Selection& selection, const RefineOptions& options,
                  const Partition& partition) {
    const auto parts = partition_cells(mesh, test::world().size(), partition);
    DistributedMesh part = distribute(test::world(), mesh, parts);
    refine(part, selection, options);
    return collect(std::move(part));
}

const std::vector<Partition> partitions{
    {.method = PartitionMethod::lepp},
    {.method = PartitionMethod::dual},
    {.method = PartitionMethod::block},
    {.method = PartitionMethod::random, .seed = 1},
    {.method = PartitionMethod::random, .seed = 2},
};

/// With one rank all partitions are the same. Under sanitizers two suffice: the most compact one,
/// and one with borders everywhere.
std::vector<Partition> partitions_that_differ() {
    if (test::world().size() == 1) return {partitions.front()};
    if (OCTETRA_SANITIZED) return {partitions.front(), partitions.back()};
    return partitions;
}

void expect_equal(const Mesh& mesh, const Selection& selection, const RefineOptions& options,
                  const std::vector<Partition>& by = {{.method = PartitionMethod::block}}) {
    const auto expected = test::world().is_first()
                              ? reference::refine(mesh, selection, options.scheme, options.levels)
                              : reference::Refinement{};
    for (const Partition& partition : by) {
        const Collected whole = refined(mesh, selection, options, partition);
        if (!test::world().is_first()) {
            EXPECT_EQ(whole.mesh.points.size(), 0U);
            continue;
        }
        EXPECT_TRUE(whole.mesh == expected.mesh);
        EXPECT_TRUE(whole.maps == expected.maps);
    }
}

class Equality : public testing::TestWithParam<std::tuple<Scheme, Synchronisation, int>> {
protected:
    const Scheme scheme = std::get<0>(GetParam());
    const Synchronisation synchronisation = std::get<1>(GetParam());
    const int levels = std::get<2>(GetParam());

    void expect_equal_by_every_partition(const Mesh& mesh,
                                         const std::vector<Selection>& selections) const {
        for (const Selection& selection : selections) {
            expect_equal(mesh, selection, {scheme, levels, synchronisation},
                         partitions_that_differ());
        }
    }
};

TEST_P(Equality, OnAShakenLatticeWithEverythingMarked) {
    expect_equal_by_every_partition(
        marked(test::perturbed_kuhn(3, 0.3, 5), 1),
        {{.random = RandomShare{0.1, 3}}, {.spheres = {{{1, 1, 1}, 0.6}}}, {.regions = {2}}});
}

TEST_P(Equality, OnALatticeFullOfTies) {
    expect_equal_by_every_partition(
        marked(test::kuhn(3, 2, 2), 2),
        {{.boxes = {{{0, 0, 0}, {1, 1, 2}}}}, {.cells = {GlobalCell{0}, GlobalCell{40}}}});
}

TEST_P(Equality, OnCoordinatesThatRound) {
    Mesh mesh = test::kuhn(2, 2, 3, 1.0 / 3);
    for (Point& p : mesh.points) p = {p.x / 7 + 1, p.y * 0.3, p.z * 1e-3};
    expect_equal_by_every_partition(mesh, {{.random = RandomShare{0.2, 3}}, {.max_volume = 2e-7}});
}

TEST_P(Equality, OnCellsThatMeetAtAVertexOrAnEdgeOnlyOrNotAtAll) {
    const Mesh mesh = test::mesh_of({{0, 0, 0},
                                     {2, 0, 0},
                                     {0, 3, 0},
                                     {0, 0, 4},
                                     {-1, -2, -3},
                                     {-3, -1, -2},
                                     {-2, -3, -1.5},
                                     {5, 5, 5},
                                     {6, 5, 5},
                                     {5, 7, 5},
                                     {5, 5, 8},
                                     {0, -3, -1},
                                     {0, -4, 1}},
                                    {{0, 1, 2, 3}, {0, 4, 5, 6}, {7, 8, 9, 10}, {0, 1, 11, 12}});
    expect_equal_by_every_partition(
        mesh, {{.all = true}, {.cells = {GlobalCell{0}}}, {.cells = {GlobalCell{2}}}});
}

INSTANTIATE_TEST_SUITE_P(SchemesSynchronisationsLevels, Equality,
                         testing::Combine(testing::Values(Scheme::eight, Scheme::four, Scheme::two),
                                          testing::Values(Synchronisation::neighbour,
                                                          Synchronisation::gateway),
                                          testing::Values(1, 3)));

TEST(Edges, EqualTheReferenceThroughFourUniformLevelsOfOneCellOnManyRanks) {
    for (const auto& corners :
         {test::tie_free_corners, test::type_o_corners, test::regular_corners}) {
        expect_equal(test::one_cell(corners), {.all = true}, {.levels = 4});
    }
}

TEST(Edges, EmptyMeshesAndVerticesOfNoCellStayAsTheyAre) {
    Mesh mesh;
    expect_equal(mesh, {.all = true}, {.levels = 2}, {partitions[0]});
    mesh = test::one_cell(test::cube_corner);
    mesh.points.insert(mesh.points.begin(), Point{9, 9, 9});
    for (VertexIndex& v : mesh.cells.front()) v = VertexIndex{v.value() + 1U};
    expect_equal(mesh, {.all = true}, {.levels = 2}, {partitions[0]});
}

TEST(Rounding, IsRefusedOnAllRanksWithTheMessageOfTheReference) {
    Mesh mesh = test::kuhn(2, 2, 2);
    for (Point& p : mesh.points) p = {p.x * 2 + 0x1p52, p.y, p.z};
    for (const Partition& partition : partitions_that_differ()) {
        const std::string expected = test::thrown_by<InputError>(
            [&] { (void)reference::refine(mesh, {.all = true}, Scheme::eight, 3); });
        const std::string message = test::thrown_by<InputError>(
            [&] { (void)refined(mesh, {.all = true}, {.levels = 3}, partition); });
        EXPECT_EQ(message, expected);
        EXPECT_THAT(message, HasSubstr("level 2"));
    }
}

TEST(Rounding, OfOneCoordinateIsEnoughToBeRefused) {
    for (double Point::*coordinate : {&Point::x, &Point::y, &Point::z}) {
        Mesh mesh = test::kuhn(1, 1, 1);
        for (Point& p : mesh.points) p.*coordinate = p.*coordinate * 2 + 0x1p52;
        const std::string expected = test::thrown_by<InputError>(
            [&] { (void)reference::refine(mesh, {.all = true}, Scheme::eight, 2); });
        EXPECT_EQ(test::thrown_by<InputError>(
                      [&] { (void)refined(mesh, {.all = true}, {.levels = 2}, partitions[2]); }),
                  expected);
    }
}

TEST(Rounding, OfTheSmallestNumbersThereAreIsRefusedToo) {
    // Sums of these are exact, and half of an odd one is not.
    constexpr double smallest = std::numeric_limits<double>::denorm_min();
    const Mesh mesh =
        test::one_cell({{{0, 0, 0}, {smallest, 0, 0}, {0, smallest, 0}, {0, 0, smallest}}});
    const std::string expected = test::thrown_by<InputError>(
        [&] { (void)reference::refine(mesh, {.all = true}, Scheme::eight, 1); });
    EXPECT_EQ(test::thrown_by<InputError>(
                  [&] { (void)refined(mesh, {.all = true}, {.levels = 1}, partitions[2]); }),
              expected);
}

/// The limit equals the final count, and is then reduced by one, which refuses the level that
/// exceeds it.
TEST(MostCells, AreCountedBeforeALevelIsMadeAndRefusedWithTheMessageOfTheReference) {
    const Mesh mesh = marked(test::perturbed_kuhn(5, 0.3, 5), 1);
    const Selection selection{.spheres = {{{0, 0, 0}, 1.1}}};
    const std::size_t most = reference::refine(mesh, selection, Scheme::eight, 3).mesh.cells.size();
    for (const Partition& partition : partitions_that_differ()) {
        constexpr double always = 10;
        for (const Tuning& tuning : {Tuning{0, 0}, Tuning{0, always}, Tuning{always, 0}}) {
            const auto refined_to = [&](std::size_t max_cells) {
                const auto ranks = partition_cells(mesh, test::world().size(), partition);
                DistributedMesh part = distribute(test::world(), mesh, ranks);
                refine(part, selection, {.levels = 3, .max_cells = max_cells}, tuning);
                return test::world().sum(part.cells.size());
            };
            EXPECT_EQ(refined_to(most), most);
            EXPECT_EQ(reference::refine(mesh, selection, Scheme::eight, 3, most).mesh.cells.size(),
                      most);
            const std::string expected = test::thrown_by<InputError>(
                [&] { (void)reference::refine(mesh, selection, Scheme::eight, 3, most - 1); });
            EXPECT_EQ(test::thrown_by<InputError>([&] { (void)refined_to(most - 1); }), expected);
            EXPECT_THAT(expected, HasSubstr("level 3 would make " + std::to_string(most)));
        }
    }
}

TEST(MostCells, AreNoMatterWhereNothingIsMarked) {
    const Mesh mesh = test::kuhn(1, 1, 1);
    const Selection none{.cells = {}};
    EXPECT_EQ(reference::refine(mesh, none, Scheme::eight, 2, 1).mesh.cells.size(), 6U);
    DistributedMesh part =
        distribute(test::world(), mesh, partition_cells(mesh, test::world().size(), partitions[2]));
    refine(part, none, {.levels = 2, .max_cells = 1});
    EXPECT_EQ(test::world().sum(part.cells.size()), 6U);
}

template <class T>
concept Summable = requires(const Communicator& processes, T number) {
    processes.sum(number);
};
template <class T>
concept SummableBefore = requires(const Communicator& processes, T number) {
    processes.sum_before(number);
};
template <class T>
concept Comparable = requires(const Communicator& processes, T number) {
    processes.max(number);
};

TEST(Communicator, TakesWholeNumbersAlone) {
    EXPECT_TRUE(Summable<int> && SummableBefore<std::uint32_t> && Comparable<std::size_t>);
    EXPECT_FALSE(Summable<double> || Summable<float>);
    EXPECT_FALSE(SummableBefore<double> || Comparable<double>);
}

TEST(Communicator, SumsBeforeAndAllToAllAndBroadcast) {
    const Communicator& world = test::world();
    const auto rank = static_cast<std::uint64_t>(world.rank());
    const auto size = static_cast<std::uint64_t>(world.size());
    EXPECT_EQ(world.sum(rank + 1), size * (size + 1) / 2);
    EXPECT_EQ(world.max(rank), size - 1);
    EXPECT_EQ(world.sum_before(rank + 1), rank * (rank + 1) / 2);
    std::vector<std::vector<std::uint64_t>> outboxes(size);
    for (std::uint64_t r = 0; r < size; ++r) outboxes[r].assign(r, rank);
    const auto inboxes = world.all_to_all(outboxes);
    for (std::uint64_t r = 0; r < size; ++r) {
        EXPECT_EQ(inboxes[r], std::vector<std::uint64_t>(rank, r));
    }
    std::vector<int> values;
    if (world.is_first()) values = {3, 1, 4};
    world.broadcast(values);
    EXPECT_THAT(values, testing::ElementsAre(3, 1, 4));
}

}  // namespace
}  // namespace octetra::distributed
