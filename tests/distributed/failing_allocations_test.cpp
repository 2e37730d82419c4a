#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/estimator_marks.hpp>
#include <octetra/distributed/exchange.hpp>
#include <octetra/distributed/fit.hpp>
#include <octetra/distributed/levels.hpp>
#include <octetra/distributed/refine.hpp>

#include "distributed/failing_allocations.hpp"
#include "distributed/marked_mesh.hpp"
#include "distributed/observed_mesh.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"

/// If one process runs out of memory at any point of a step, all processes throw, and the mesh is
/// unchanged.
namespace octetra::distributed {
namespace {

using test::allocations_left;
using test::never;
using test::try_work;

/// Few cells, and those left unordered by that; many, so that the canonical order is restored; and
/// all.
const std::vector<Selection> steps{
    {.spheres = {{{0.5, 0.5, 0.5}, 0.45}}},
    {.spheres = {{{0.5, 0.5, 0.5}, 0.4}}},
    {.random = RandomShare{0.3, 5}},
    {.all = true},
};

/// The mesh before this step.
AdaptiveMesh before_step(std::size_t step, Closure closure) {
    Mesh whole = test::marked(test::perturbed_kuhn(5, 0.2, 1), 1);
    test::mark_duplicates(whole.facets, whole.facet_markers);
    test::mark_duplicates(whole.edges, whole.edge_markers);
    const Partition in_blocks{.method = PartitionMethod::block};
    AdaptiveMesh mesh = AdaptiveMesh::distribute(
        test::world(), whole, partition_cells(whole, test::world().size(), in_blocks));
    for (std::size_t k = 0; k < step; ++k) (void)mesh.refine(steps[k], {.closure = closure});
    return mesh;
}

/// Refuses every allocation of the work that prepare(mesh) returns, in turn on each process, and
/// checks each time that the mesh is unchanged, until the work is completed on all. Returns the
/// number of refused allocations on all processes. If there are many, allocations soon after a
/// refused one are skipped.
std::uint64_t fail_each_allocation_of_step(std::size_t step, auto&& prepare,
                                           Closure closure = Closure::longest_edge) {
    const Communicator& world = test::world();
    long failures = 0;
    for (int rank = 0; rank < world.size(); ++rank) {
        AdaptiveMesh mesh = before_step(step, closure);
        auto work = prepare(mesh);
        const test::ObservedMesh before(mesh);
        for (long allocations = 0;; allocations += 1 + allocations / 100) {
            const bool done = try_work(allocations, rank, work);
            const auto done_on = static_cast<int>(world.sum(done ? 1 : 0));
            EXPECT_EQ(done_on, done ? world.size() : 0) << allocations;
            if (done_on > 0) break;
            ++failures;
            EXPECT_TRUE(before == test::ObservedMesh(mesh))
                << "rank " << rank << ", after " << allocations;
        }
    }
    return static_cast<std::uint64_t>(failures);
}

TEST(FailingAllocations, OfAStepLeaveTheMeshAsItWasOnAllProcesses) {
    for (std::size_t step = 0; step < steps.size(); ++step) {
        for (const auto synchronisation : {Synchronisation::neighbour, Synchronisation::gateway}) {
            const std::uint64_t failures =
                fail_each_allocation_of_step(step, [&](AdaptiveMesh& mesh) {
                    return [&] {
                        (void)mesh.refine(steps[step], {.synchronisation = synchronisation});
                    };
                });
            EXPECT_GE(failures, 20U);
        }
    }
}

TEST(FailingAllocations, OfARegularStepOrItsCoarseningLeaveTheMeshAsItWasOnAllProcesses) {
    constexpr StepOptions regular{.closure = Closure::regular};
    for (std::size_t step = 0; step < steps.size(); ++step) {
        const std::uint64_t failures = fail_each_allocation_of_step(
            step,
            [&](AdaptiveMesh& mesh) { return [&] { (void)mesh.refine(steps[step], regular); }; },
            Closure::regular);
        EXPECT_GE(failures, 20U);
    }
    const std::uint64_t failures = fail_each_allocation_of_step(
        2, [&](AdaptiveMesh& mesh) { return [&] { (void)mesh.coarsen(steps[0]); }; },
        Closure::regular);
    EXPECT_GE(failures, 50U);
}

TEST(FailingAllocations, OfAStepBySoManyMarkedEdgesLeaveTheMeshAsItWas) {
    const std::uint64_t failures = fail_each_allocation_of_step(1, [&](AdaptiveMesh& mesh) {
        std::vector<EdgeVertices> edges;
        for (const CellVertices& cell : mesh.cells()) edges.push_back({cell[3], cell[0]});
        return [edges, &mesh] { (void)mesh.refine_edges(edges); };
    });
    EXPECT_GE(failures, 20U);
}

/// Few and many cells, by the incremental and the full algorithm; checks that some allocations were
/// refused.
TEST(FailingAllocations, OfCoarseningLeaveTheMeshAsItWasOnAllProcesses) {
    for (const Selection& may_coarsen : {steps[0], steps[3]}) {
        const std::uint64_t failures = fail_each_allocation_of_step(
            2, [&](AdaptiveMesh& mesh) { return [&] { (void)mesh.coarsen(may_coarsen); }; });
        EXPECT_GE(failures, 50U);
    }
}

TEST(FailingAllocations, OfMovingCellsLeaveTheMeshAsItWasOnAllProcesses) {
    const int size = test::world().size();
    const std::uint64_t failures = fail_each_allocation_of_step(3, [&](AdaptiveMesh& mesh) {
        std::vector<int> ranks;
        for (const std::uint64_t root : mesh.roots())
            ranks.push_back(static_cast<int>(root) % size);
        return [ranks, &mesh] { (void)mesh.migrate(ranks); };
    });
    EXPECT_TRUE(failures >= 200 || size == 1);
}

TEST(FailingAllocations, OfRebalancingLeaveTheMeshAsItWasOnAllProcesses) {
    const std::uint64_t failures = fail_each_allocation_of_step(3, [&](AdaptiveMesh& mesh) {
        return [&] { (void)mesh.rebalance({.most_over_mean = 1}); };
    });
    EXPECT_TRUE(failures >= 300 || test::world().size() == 1);
}

TEST(FailingAllocations, OfAStepBeforeWhichCellsMoveLeaveTheMeshAsItWas) {
    for (const std::size_t step : {1U, 2U}) {
        const std::uint64_t failures = fail_each_allocation_of_step(step, [&](AdaptiveMesh& mesh) {
            return [&] { (void)mesh.refine_evenly(steps[step], {.most_over_mean = 1}); };
        });
        EXPECT_TRUE(failures >= 300 || test::world().size() == 1);
    }
}

TEST(FailingAllocations, OfAStepBeforeWhichCellsBecomeRootsLeaveTheMeshAsItWas) {
    constexpr BalanceOptions forgetting{.most_over_mean = 1, .may_forget_history = true};
    const std::uint64_t failures = fail_each_allocation_of_step(2, [&](AdaptiveMesh& mesh) {
        return [&] { (void)mesh.refine_evenly(steps[2], forgetting); };
    });
    EXPECT_TRUE(failures >= 250 || test::world().size() == 1);
}

/// After loading a checkpoint the lowest process with an adjacent cell has a tagged facet, and the
/// facet then migrates to another rank than the first of these cells.
TEST(FailingAllocations, OfRecallingHistoryLeaveTheMeshUnchanged) {
    constexpr BalanceOptions forgetting{.most_over_mean = 1, .may_forget_history = true};
    const std::uint64_t failures = fail_each_allocation_of_step(2, [&](AdaptiveMesh& mesh) {
        const test::SharedFolder folder;
        mesh.save(folder / "a.octetra");
        mesh = AdaptiveMesh::load(test::world(), folder / "a.octetra",
                                  {.method = PartitionMethod::random, .seed = 1});
        (void)mesh.refine_evenly(steps[2], forgetting);
        EXPECT_EQ(mesh.has_forgotten_history(), test::world().size() > 1);
        return [&] { (void)mesh.recall_history(); };
    });
    EXPECT_TRUE(failures >= 300 || test::world().size() == 1);
}

/// A DistributedMesh, which is wrapped in an AdaptiveMesh for the migration.
TEST(FailingAllocations, OfALevelBeforeWhichCellsMoveLeaveTheMeshAsItWas) {
    const Mesh whole = test::marked(test::perturbed_kuhn(4, 0.2, 1), 1);
    const Partition in_blocks{.method = PartitionMethod::block};
    const auto parts = partition_cells(whole, test::world().size(), in_blocks);
    for (int rank = 0; rank < test::world().size(); ++rank) {
        for (long allocations = 0;; allocations += 1 + allocations / 20) {
            DistributedMesh mesh = distribute(test::world(), whole, parts);
            refine(mesh, steps[0], {});
            const auto level = [&] {
                refine(mesh, steps[1], {.balance = BalanceOptions{.most_over_mean = 1}});
            };
            const std::size_t cells = mesh.cells.size();
            const bool done = try_work(allocations, rank, level);
            ASSERT_EQ(test::world().sum(done ? 1 : 0), done ? test::world().size() : 0);
            EXPECT_TRUE(done || mesh.cells.size() == cells) << allocations;
            if (!done) refine(mesh, steps[1], {});
            const Mesh found = collect(std::move(mesh)).mesh;
            AdaptiveMesh expected = AdaptiveMesh::distribute(test::world(), whole, parts);
            for (std::size_t k = 0; k < 2; ++k) (void)expected.refine(steps[k]);
            EXPECT_TRUE(found == expected.collect()) << allocations;
            if (done) break;
        }
    }
}

TEST(FailingAllocations, OfExpressionsLeaveTheMeshAsItWasOnAllProcesses) {
    const Selection selection{
        .where = {Expression("distance(3) < 0.1 or boundary and generation < 1")},
        .narrowed_by = {{.where = {Expression("longest > 0.05")}}}};
    const std::uint64_t refused = fail_each_allocation_of_step(
        1, [&](AdaptiveMesh& mesh) { return [&] { (void)mesh.refine(selection); }; });
    EXPECT_GT(refused, 200U);
}

TEST(FailingAllocations, OfFitsAndPredictionsLeaveTheMeshAsItWasOnAllProcesses) {
    for (const Closure closure : {Closure::longest_edge, Closure::regular}) {
        const auto prepare = [&](AdaptiveMesh& mesh) {
            const FitOptions options{.step = {.closure = closure}};
            const auto fit = std::make_shared<Fit>(mesh, options);
            const std::vector<double> sizes = mesh.cell_values(Expression("0.2 + x"));
            const std::vector<std::uint8_t> all(sizes.size(), 1);
            return [&mesh, fit, sizes, all, step = options.step] {
                (void)mesh.marks_within(all, 2000, step);
                (void)fit->misfit_cells(sizes);
                (void)fit->next(sizes);
            };
        };
        EXPECT_GT(fail_each_allocation_of_step(1, prepare, closure), 200U);
    }
}

TEST(FailingAllocations, OfSizesAreThrownOnAllProcesses) {
    for (const char* const text :
         {"longest > size(h)", "longest > graded(x, 1.2)", "longest > background(b)"}) {
        SCOPED_TRACE(text);
        const Selection selection{.where = {Expression(text)}};
        const std::uint64_t refused = fail_each_allocation_of_step(1, [&](AdaptiveMesh& mesh) {
            const Field sizes{"h", FieldOn::vertices, 1,
                              std::vector<double>(mesh.points().size(), 0.1)};
            const Background background = mesh.as_background("b", sizes);
            return [&mesh, &selection, sizes, background] {
                (void)mesh.marked_cells(selection, std::span(&sizes, 1), std::span(&background, 1));
            };
        });
        EXPECT_GT(refused, 50U);
    }
}

TEST(FailingAllocations, OfABackgroundAreThrownOnAllProcesses) {
    const std::uint64_t refused = fail_each_allocation_of_step(1, [](AdaptiveMesh& mesh) {
        const Field sizes{"h", FieldOn::vertices, 1,
                          std::vector<double>(mesh.points().size(), 0.1)};
        return [&mesh, sizes] { (void)mesh.as_background("b", sizes); };
    });
    EXPECT_GT(refused, 10U);
}

TEST(FailingAllocations, OfLevelsAreThrownOnAllProcesses) {
    const std::uint64_t refused = fail_each_allocation_of_step(2, [&](AdaptiveMesh& mesh) {
        const Levels levels = mesh.levels();
        const std::vector<double> values(levels.points(1).size(), 1);
        return [&mesh, levels, values] {
            (void)mesh.levels();
            (void)levels.prolongation(0);
            (void)levels.restrict_residual(1, values);
        };
    });
    EXPECT_GT(refused, 100U);
}

TEST(FailingAllocations, OfTransferringValuesAreThrownOnAllProcesses) {
    const int size = test::world().size();
    const std::uint64_t failures = fail_each_allocation_of_step(1, [&](AdaptiveMesh& mesh) {
        const std::vector<double> values(mesh.cells().size(), 1);
        ValueLists<int> lists;
        for (std::size_t v = 0; v < mesh.points().size(); ++v) {
            lists.values.push_back(1);
            lists.begin.push_back(lists.values.size());
        }
        std::vector<int> ranks;
        for (const std::uint64_t root : mesh.roots())
            ranks.push_back(static_cast<int>(root) % size);
        AdaptiveMesh moved = before_step(1, Closure::longest_edge);
        return [=, migration = moved.migrate(ranks)] {
            const long left =
                std::exchange(allocations_left, never);  // the caller makes the copies
            auto copy_of_values = values;
            auto copy_of_lists = lists;
            allocations_left = left;
            (void)migration.cells(std::move(copy_of_values));
            (void)migration.vertices(std::move(copy_of_lists));
        };
    });
    EXPECT_TRUE(failures >= 10 || size == 1);
}

TEST(FailingAllocations, OfAnExchangeAreThrownOnAllProcesses) {
    const std::uint64_t failures = fail_each_allocation_of_step(1, [&](AdaptiveMesh& mesh) {
        std::vector<double> values(mesh.points().size(), 1);
        std::vector<double> of_cells(mesh.cells().size(), 1);
        GhostLayer ghosts = mesh.ghosts(GhostsBy::vertex);
        return [values, of_cells, ghosts, &mesh]() mutable {
            update_copies(mesh.processes(), mesh.vertex_sharing(), values.size(),
                          std::span(values));
            (void)ghosts.values(mesh.processes(), of_cells);
        };
    });
    EXPECT_TRUE(failures >= 10 || test::world().size() == 1);
}

TEST(FailingAllocations, OfMarkingByIndicatorsAreThrownOnAllProcesses) {
    const std::uint64_t failures = fail_each_allocation_of_step(1, [&](AdaptiveMesh& mesh) {
        std::vector<double> indicators(mesh.cells().size(), 0.1);
        return [indicators, &mesh] {
            (void)mark_bulk(mesh.processes(), indicators, 0.5);
            (void)mark_maximum(mesh.processes(), indicators, 0.5);
            (void)mark_fraction(mesh.processes(), indicators, 0.5);
        };
    });
    EXPECT_GE(failures, 3U);
}

/// A small mesh, whose saving needs few allocations.
AdaptiveMesh to_save() {
    const Mesh whole = test::marked(test::perturbed_kuhn(3, 0.2, 1), 1);
    const Partition in_blocks{.method = PartitionMethod::block};
    AdaptiveMesh mesh = AdaptiveMesh::distribute(
        test::world(), whole, partition_cells(whole, test::world().size(), in_blocks));
    for (std::size_t k = 0; k < 2; ++k) (void)mesh.refine(steps[k]);
    return mesh;
}

std::string content_if_there(const std::filesystem::path& path) {
    return std::filesystem::exists(path) ? test::content_of(path) : std::string("none");
}

/// Returns whether there is an incomplete file.
bool leaves_unfinished(const test::SharedFolder& folder) {
    const std::filesystem::directory_iterator files((folder / ".").parent_path());
    return std::any_of(begin(files), end(files),
                       [](const auto& file) { return file.path().extension() == ".tmp"; });
}

/// With and without an existing file.
TEST(FailingAllocations, OfSavingLeaveTheMeshAndTheOldFileUnchanged) {
    const Communicator& world = test::world();
    const test::SharedFolder folder;
    AdaptiveMesh mesh = to_save();
    const std::vector<Field> fields{
        {"u", FieldOn::vertices, 2, std::vector<double>(2 * mesh.points().size(), 1.5)},
        {"n", FieldOn::cells, 1, std::vector<std::int32_t>(mesh.cells().size(), 7)}};
    mesh.save(folder / "good.octetra", fields);
    const std::string good = test::content_of(folder / "good.octetra");
    const test::ObservedMesh before(mesh);
    long failures = 0;
    for (const std::string old : {"none", "old"}) {
        for (int rank = 0; rank < world.size(); ++rank) {
            const std::filesystem::path place = folder / (old + std::to_string(rank) + ".octetra");
            if (world.is_first() && old != "none") std::ofstream(place) << old;
            for (long allocations = 0;; ++allocations) {
                (void)world.max(0);  // all have inspected the folder
                const bool done = try_work(allocations, rank, [&] { mesh.save(place, fields); });
                const std::uint64_t done_on = world.sum(done ? 1 : 0);
                ASSERT_EQ(done_on, done ? static_cast<std::uint64_t>(world.size()) : 0U);
                ASSERT_TRUE(content_if_there(place) == (done ? good : old)) << allocations;
                ASSERT_FALSE(leaves_unfinished(folder)) << allocations;
                if (done) break;
                ++failures;
            }
            EXPECT_TRUE(before == test::ObservedMesh(mesh)) << "rank " << rank;
        }
    }
    EXPECT_GE(failures, 300);
}

}  // namespace
}  // namespace octetra::distributed
