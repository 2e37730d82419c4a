#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <mpi.h>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh_share.hpp>
#include <octetra/distributed/mpi.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/distributed/read_parts.hpp>
#include <octetra/distributed/refine.hpp>

#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "level/tuning.hpp"
#include "support/meshes.hpp"
#include "support/mpi_counter.hpp"

/// Bounds of the communication of synchronisation, valid for every mesh, partition and rank. The
/// figures are those of the profile, which profile_test.cpp compares with MPI.
namespace octetra::distributed {
namespace {

/// The border of a rank before a level.
struct Border {
    std::uint64_t neighbours = 0;
    std::uint64_t edges = 0;  ///< in all interfaces
};

Border border_of(const DistributedMesh& mesh) {
    Border border{.neighbours = mesh.interfaces.size()};
    for (const Interface& interface : mesh.interfaces) border.edges += interface.edges.size();
    return border;
}

struct LevelFigures {
    std::vector<std::vector<Border>> borders;  ///< [rank], one level each
    std::vector<PhaseCounts> of_rank;          ///< of each rank, in the phase "synchronise"
};

/// Collective. Refines once; returns the figures on the first process.
LevelFigures refine_once(DistributedMesh& mesh, const Selection& selection, Scheme scheme,
                         Synchronisation synchronisation, const Tuning& tuning = {}) {
    LevelFigures figures;
    figures.borders = test::world().gather(std::vector{border_of(mesh)});
    mesh.processes = profiled(test::world(), ProfileDetail::sums);
    refine(mesh, selection, {scheme, 1, synchronisation}, tuning);
    for (ProfiledPhase& phase : gather_profile(mesh.processes).phases) {
        if (phase.name == "synchronise") figures.of_rank = std::move(phase.of_rank);
    }
    mesh.processes = test::world();
    return figures;
}

DistributedMesh distributed_lattice(std::size_t n, const Partition& partition) {
    const Mesh mesh = test::perturbed_kuhn(n, 0.2, 5);
    return distribute(test::world(), mesh, partition_cells(mesh, test::world().size(), partition));
}

/// Refines three levels by every scheme and some partitions, and calls check(figures, rank) for
/// each rank and level.
void for_each_level(Synchronisation synchronisation, auto&& check) {
    std::uint64_t bytes = 0;
    for (const Partition& partition :
         {Partition{.method = PartitionMethod::lepp}, Partition{.method = PartitionMethod::block},
          Partition{.method = PartitionMethod::random, .seed = 1}}) {
        for (const Scheme scheme : {Scheme::eight, Scheme::four, Scheme::two}) {
            DistributedMesh mesh = distributed_lattice(4, partition);
            for (int level = 1; level <= 3; ++level) {
                const LevelFigures figures =
                    refine_once(mesh, {.random = RandomShare{0.2, 3}}, scheme, synchronisation);
                for (std::size_t r = 0; r < figures.of_rank.size(); ++r) {
                    check(figures, r);
                    bytes += figures.of_rank[r].bytes;
                }
            }
        }
    }
    if (!test::world().is_first()) return;
    EXPECT_EQ(bytes > 0, test::world().size() > 1);
}

TEST(Communication, OfNeighboursIsAMessageARoundAndAtMostFourBytesAnEdgeOfTheBorder) {
    for_each_level(Synchronisation::neighbour, [](const LevelFigures& figures, std::size_t r) {
        const PhaseCounts& counts = figures.of_rank[r];
        const Border& border = figures.borders[r].front();
        EXPECT_LE(counts.messages, counts.rounds * border.neighbours);
        EXPECT_LE(counts.bytes, 4 * border.edges);
        // Each round has a sum over all ranks, and one more finds that no marks are pending.
        EXPECT_EQ(counts.collectives, test::world().size() > 1 ? counts.rounds + 1 : 0);
    });
}

TEST(Communication, ThroughTheGatewayIsAMessageARoundEachWayAndTwelveBytesASelection) {
    for_each_level(Synchronisation::gateway, [](const LevelFigures& figures, std::size_t r) {
        const PhaseCounts& counts = figures.of_rank[r];
        const std::uint64_t others = figures.of_rank.size() - 1;
        std::uint64_t edges = figures.borders[r].front().edges;
        if (r == 0) {
            for (std::size_t other = 1; other <= others; ++other) {
                edges += figures.borders[other].front().edges;
            }
        }
        EXPECT_LE(counts.messages, counts.rounds * (r == 0 ? others : 1));
        EXPECT_LE(counts.bytes, 12 * edges);
    });
}

constexpr Tuning always_incremental{.incremental_below = 10};
constexpr Tuning always_sweep{.incremental_below = 0};

/// The bytes that each rank sends in one refinement by 2t of six cells round an edge that is the
/// longest of all, distributed over as many ranks as possible.
std::vector<std::uint64_t> bytes_sent_in_a_ring(const Selection& selection,
                                                Synchronisation synchronisation,
                                                const Tuning& tuning) {
    const Mesh ring = test::kuhn(1, 1, 1);
    std::vector<int> cell_to_part;
    for (int c = 0; c < 6; ++c) cell_to_part.push_back(c % test::world().size());
    DistributedMesh mesh = distribute(test::world(), ring, cell_to_part);
    std::vector<std::uint64_t> bytes;
    for (const PhaseCounts& counts :
         refine_once(mesh, selection, Scheme::two, synchronisation, tuning).of_rank) {
        EXPECT_EQ(counts.rounds, test::world().size() > 1 ? 1 : 0);
        bytes.push_back(counts.bytes);
    }
    return bytes;
}

/// The number of ranks that have a cell of the ring.
std::size_t sharers_of_a_ring() {
    return static_cast<std::size_t>(std::min(test::world().size(), 6));
}

TEST(Communication, OfNeighboursIsNotReturnedToTheSender) {
    const Selection one_cell{.cells = {GlobalCell{0}}};  // owned by the first rank
    for (const Tuning& tuning : {always_sweep, always_incremental}) {
        const auto bytes = bytes_sent_in_a_ring(one_cell, Synchronisation::neighbour, tuning);
        for (std::size_t r = 0; r < bytes.size(); ++r) {
            EXPECT_EQ(bytes[r], r == 0 ? 4 * (sharers_of_a_ring() - 1) : 0) << "rank " << r;
        }
    }
}

TEST(Communication, ThroughTheGatewayIsNotPassedOnToItsSenders) {
    const auto bytes = bytes_sent_in_a_ring({.all = true}, Synchronisation::gateway, always_sweep);
    for (std::size_t r = 0; r < bytes.size(); ++r) {
        const bool speaks = r > 0 && r < sharers_of_a_ring();
        EXPECT_EQ(bytes[r], speaks ? 12 * (sharers_of_a_ring() - 1) : 0) << "rank " << r;
    }
}

TEST(Communication, TakesNoMoreRoundsAsTheMeshGrows) {
    for (const Scheme scheme : {Scheme::eight, Scheme::two}) {
        std::vector<std::uint64_t> rounds;
        for (const std::size_t n : {5U, 10U, 20U}) {
            DistributedMesh mesh = distributed_lattice(n, {.method = PartitionMethod::block});
            const Selection selection{.random = RandomShare{0.05, 3}};
            rounds.push_back(refine(mesh, selection, {.scheme = scheme, .levels = 1}).rounds);
        }
        // The larger meshes have 8 and 64 times as many cells; their paths are longer only by
        // chance.
        EXPECT_LE(rounds[1], rounds[0] + 1);
        EXPECT_LE(rounds[2], rounds[0] + 1);
    }
}

/// A process knows what it sends, but not what it will receive.
TEST(Communication, OfAllWithAllSendsNoEmptyMessages) {
    const Communicator& world = test::world();
    const auto size = static_cast<std::size_t>(world.size());
    const auto rank = static_cast<std::size_t>(world.rank());
    for (std::size_t round = 0; round < 50; ++round) {
        // Every other process sends to the next one; sometimes more than fits in one message.
        const auto sends = [&](std::size_t r) { return r % 2 == round % 2; };
        const std::size_t longest = round % 10 == 0 ? 400'000 : 3;
        std::vector<std::vector<std::uint64_t>> outboxes(size);
        if (sends(rank)) outboxes[(rank + 1) % size].assign(rank == 0 ? longest : 2, rank + round);
        const test::MpiCounts before = test::mpi_counts();
        const auto inboxes = world.all_to_all(outboxes);
        const test::MpiCounts after = test::mpi_counts();
        const std::size_t pieces = rank == 0 && longest > 3 ? 5 : 1;  // the size, and four pieces
        EXPECT_EQ(after.messages - before.messages, size > 1 && sends(rank) ? pieces : 0U);
        EXPECT_EQ(after.collectives - before.collectives, size > 1 ? 1U : 0U);
        const std::size_t sender = (rank + size - 1) % size;
        for (std::size_t r = 0; r < size; ++r) {
            const std::vector<std::uint64_t> expected(sender == 0 ? longest : 2, sender + round);
            EXPECT_TRUE(inboxes[r] ==
                        (r == sender && sends(sender) ? expected : std::vector<std::uint64_t>{}))
                << r << " to " << rank << " in round " << round;
        }
    }
}

TEST(Communication, OfAFewBytesOfEveryProcessIsCollective) {
    const Communicator& world = test::world();
    const auto bytes_of = [](std::size_t r) {
        return ProcessGroup::Bytes(3 * r, static_cast<std::byte>(r));
    };
    const auto rank = static_cast<std::size_t>(world.rank());
    const test::MpiCounts before = test::mpi_counts();
    const std::vector<ProcessGroup::Bytes> all = world.of_all(bytes_of(rank));
    EXPECT_EQ(test::mpi_counts().messages, before.messages);
    ASSERT_EQ(all.size(), static_cast<std::size_t>(world.size()));
    for (std::size_t r = 0; r < all.size(); ++r) EXPECT_EQ(all[r], bytes_of(r));
}

/// The messages are proportional to the lines, vertices and cells of the file.
TEST(Communication, OfReadingAFileOfOneCellDoesNotGrowWithTheProcesses) {
    const test::SharedFolder folder;
    for (const std::string name : {"m.ele", "m.mesh", "m.meshb", "m.msh"}) {
        const std::filesystem::path file = folder / name;
        test::world().on_first(
            [&] { (void)write_mesh(test::one_cell(test::regular_corners), file); });
        const test::MpiCounts before = test::mpi_counts();
        (void)read_parts(test::world(), file, {.method = PartitionMethod::rcb}, {});
        const std::uint64_t here = test::mpi_counts().messages - before.messages;
        EXPECT_LE(test::world().sum(here), 40U) << name;
    }
}

/// One process locates the blocks of nodes and elements one after the other, for all processes.
TEST(Communication, OfReadingBlocksOfGmshTakesNoMoreCallsOfAllWithMoreProcesses) {
    const Communicator& world = test::world();
    if (world.size() < 3) GTEST_SKIP() << "there are no two groups";
    const test::SharedFolder folder;
    const std::filesystem::path file = folder / "m.msh";
    world.on_first([&] { (void)write_mesh(test::perturbed_kuhn(3, 0.2, 1), file); });
    const auto calls_of_all = [&](const Communicator& group) {
        const test::MpiCounts before = test::mpi_counts();
        EXPECT_TRUE(read_mesh_share(file, group).has_value());
        return test::mpi_counts().collectives - before.collectives;
    };
    const bool is_in_pair = world.rank() < 2;
    MPI_Comm part = MPI_COMM_NULL;
    MPI_Comm_split(comm_of(world), is_in_pair ? 0 : MPI_UNDEFINED, world.rank(), &part);
    std::uint64_t in_pair = 0;
    if (is_in_pair) {
        in_pair = calls_of_all(communicator_of(part));
        MPI_Comm_free(&part);
    }
    const std::uint64_t in_world = calls_of_all(world);
    if (is_in_pair) {
        EXPECT_EQ(in_world, in_pair);
    }
}

TEST(DuplicateOfACommunicator, IsUsedAgainOnceNoProcessUsesItAnyMore) {
    const Communicator& world = test::world();
    if (world.size() == 1) GTEST_SKIP() << "one process needs none";
    Communicator first = communicator_of(MPI_COMM_WORLD);
    const MPI_Comm used = comm_of(first);
    if (world.rank() == world.size() - 1) first = Communicator();  // released before the others
    Communicator second = communicator_of(MPI_COMM_WORLD);
    EXPECT_NE(comm_of(second), used);
    first = Communicator();
    second = Communicator();
    MPI_Comm same_processes = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, 0, world.rank(), &same_processes);
    const Communicator third = communicator_of(same_processes);
    MPI_Comm_free(&same_processes);
    EXPECT_EQ(comm_of(third), used);
    EXPECT_EQ(third.sum(std::uint64_t{1}), static_cast<std::uint64_t>(world.size()));
}

TEST(DuplicateOfACommunicator, IsNotUsedForTheSameProcessesInAnotherOrder) {
    const Communicator& world = test::world();
    if (world.size() == 1) GTEST_SKIP() << "one process has no order";
    (void)communicator_of(MPI_COMM_WORLD);
    MPI_Comm backwards = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, 0, -world.rank(), &backwards);
    const Communicator reversed = communicator_of(backwards);
    MPI_Comm_free(&backwards);
    EXPECT_EQ(reversed.rank(), world.size() - 1 - world.rank());
    EXPECT_EQ(reversed.of_rank(0, world.rank()), world.size() - 1);
}

}  // namespace
}  // namespace octetra::distributed
