#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/sol_fields.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/read_parts.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/verify/mesh_slice.hpp>

#include "checkpoint/load.hpp"
#include "distributed/failing_allocations.hpp"
#include "distributed/gmsh_text.hpp"
#include "distributed/marked_mesh.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "output/canonical_slices.hpp"
#include "output/own_piece.hpp"
#include "sharing/vertex_sharing.hpp"
#include "support/temporary_folder.hpp"

/// Failing allocations in collective operations that have no mesh yet: exchanges and reading.
namespace octetra::distributed {
namespace {

using test::allocations_left;
using test::fail_each_allocation;
using test::never;
using test::try_work;

/// As used by the verifier and the readers of files, without agreement on failures by the caller.
TEST(FailingAllocations, OfAnExchangeBetweenProcessesOfAnyKindAreThrownOnAll) {
    const Communicator& world = test::world();
    const ProcessGroup& group = world;
    const auto size = static_cast<std::size_t>(world.size());
    for (int rank = 0; rank < world.size(); ++rank) {
        for (long allocations = 0;; ++allocations) {
            std::vector<ProcessGroup::Bytes> to_each(size, ProcessGroup::Bytes(100));
            std::vector<ProcessGroup::Bytes> come;
            const bool done =
                try_work(allocations, rank, [&] { come = group.exchange(std::move(to_each)); });
            ASSERT_EQ(world.sum(done ? 1 : 0), done ? size : 0) << rank << ' ' << allocations;
            if (!done) continue;
            for (const ProcessGroup::Bytes& bytes : come) EXPECT_EQ(bytes.size(), 100U);
            EXPECT_TRUE(allocations >= world.size());
            break;
        }
    }
}

TEST(FailingAllocations, OfAllToAllExchangesAreThrownOnAll) {
    const Communicator& world = test::world();
    const auto size = static_cast<std::size_t>(world.size());
    for (int rank = 0; rank < world.size(); ++rank) {
        for (long allocations = 0;; ++allocations) {
            ProcessGroup::Bytes bytes(100 * static_cast<std::size_t>(world.rank()));
            std::vector<ProcessGroup::Bytes> come;
            const bool done =
                try_work(allocations, rank, [&] { come = world.of_all(std::move(bytes)); });
            ASSERT_EQ(world.sum(done ? 1 : 0), done ? size : 0) << rank << ' ' << allocations;
            if (!done) continue;
            for (std::size_t r = 0; r < size; ++r) EXPECT_EQ(come[r].size(), 100 * r);
            EXPECT_TRUE(size == 1 || allocations >= 4);
            break;
        }
    }
}

TEST(FailingAllocations, OfABroadcastAreThrownOnAllProcesses) {
    const Communicator& world = test::world();
    std::vector<int> values(world.is_first() ? 1000 : 0, 7);
    const std::uint64_t failures = fail_each_allocation([&] {
        if (!world.is_first()) std::vector<int>().swap(values);
        world.broadcast(values);
    });
    EXPECT_EQ(values, std::vector<int>(1000, 7));
    EXPECT_GE(failures, static_cast<std::uint64_t>(world.size()) - 1);
}

TEST(FailingAllocations, OfReadingAFileTogetherAreThrownOnAllProcesses) {
    if (test::world().size() == 1) return;  // a single process reads without exchanges
    const test::SharedFolder folder;
    Mesh mesh = test::marked(test::perturbed_kuhn(2, 0.2, 1), 1);
    for (Marker& marker : mesh.facet_markers) marker = 3;
    for (Marker& marker : mesh.edge_markers) marker = 4;
    const auto backwards = [&](std::uint64_t v) { return 2 * (mesh.points.size() - v); };
    const test::GmshText with_gaps(mesh, {.format = {true, true}, .tag_of = backwards});
    for (const std::string name : {"m.ele", "m.mesh", "m.msh", "tags_with_gaps.msh"}) {
        const std::filesystem::path file = folder / name;
        const Partition by_coordinates{.method = PartitionMethod::rcb};
        const Selection box{.boxes = {{{0, 0, 0}, {1, 1, 1}}}};
        const auto weigh = [&](const CellsToWeigh& cells) {
            return predicted_cells(cells, box, Scheme::eight, 2);
        };
        const ReadPartsOptions options{.read = {}, .on_facts = {}, .weigh = weigh};
        test::world().on_first([&] {
            if (name == "tags_with_gaps.msh") return test::write_file(file, with_gaps.text());
            (void)write_mesh(mesh, file);
        });
        const std::uint64_t failures = fail_each_allocation(
            [&] { (void)read_parts(test::world(), file, by_coordinates, options); });
        EXPECT_GE(failures, 100U);
    }
}

TEST(FailingAllocations, OfReadingValuesTogetherAreThrownOnAllProcesses) {
    if (test::world().size() == 1) return;  // a single process reads without exchanges
    const test::SharedFolder folder;
    const std::filesystem::path file = folder / "v.sol";
    test::world().on_first([&] {
        test::write_file(file,
                         "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n4\n1 1\n"
                         "1\n2\n3\n4\nSolAtTetrahedra\n1\n1 2\n1 2 3\nEnd\n");
    });
    const std::uint64_t failures = fail_each_allocation([&] {
        (void)read_sol_share(file, EntityCounts{4, 1}, test::world());
    });
    EXPECT_GE(failures, 10U);
}

Mesh mesh_with_markers() {
    Mesh whole = test::marked(test::perturbed_kuhn(2, 0.2, 1), 1);
    for (Marker& marker : whole.facet_markers) marker = 3;
    for (Marker& marker : whole.edge_markers) marker = 4;
    return whole;
}

TEST(FailingAllocations, OfLoadingACheckpointAreThrownOnAllProcesses) {
    const test::SharedFolder folder;
    const std::filesystem::path file = folder / "m.octetra";
    Mesh whole = mesh_with_markers();
    const std::vector<int> ranks(whole.cells.size(), 0);
    AdaptiveMesh mesh = AdaptiveMesh::distribute(test::world(), std::move(whole), ranks);
    (void)mesh.refine(Selection{.random = RandomShare{0.3, 1}});
    mesh.save(file);
    const CheckpointReader reader(file);
    const Partition by_coordinates{.method = PartitionMethod::rcb};
    const std::uint64_t failures = fail_each_allocation([&] {
        LoadedPart part = load_part(test::world(), reader, file, by_coordinates);
        (void)distribute_parts(test::world(), std::move(part.input));
    });
    EXPECT_GE(failures, 100U);
}

TEST(FailingAllocations, OfLoadingAMeshAndFieldsAreThrownOnAllProcesses) {
    const test::SharedFolder folder;
    const std::filesystem::path file = folder / "m.octetra";
    Mesh whole = mesh_with_markers();
    const Partition in_blocks{.method = PartitionMethod::block};
    const auto ranks = partition_cells(whole, test::world().size(), in_blocks);
    AdaptiveMesh mesh = AdaptiveMesh::distribute(test::world(), std::move(whole), ranks);
    (void)mesh.refine(Selection{.random = RandomShare{0.3, 1}});
    const std::vector<Field> saved{
        {"u", FieldOn::vertices, 2, std::vector<double>(2 * mesh.points().size(), 1.5)},
        {"n", FieldOn::cells, 1, std::vector<std::int32_t>(mesh.cells().size(), 7)}};
    mesh.save(file, saved);
    const Partition by_coordinates{.method = PartitionMethod::rcb};
    std::vector<Field> fields;
    const std::uint64_t failures = fail_each_allocation([&] {
        fields.clear();
        (void)AdaptiveMesh::load(test::world(), file, by_coordinates, &fields);
    });
    EXPECT_EQ(fields.size(), 2U);
    EXPECT_GE(failures, 100U);
}

/// For a `.pvtu` each process writes its part, with the markers and values on which all agree.
TEST(FailingAllocations, OfAPieceToWriteAreThrownOnAllProcesses) {
    const Mesh whole = test::marked(test::perturbed_kuhn(2, 0.2, 1), 1);
    const Partition in_blocks{.method = PartitionMethod::block};
    const DistributedMesh mesh =
        distribute(test::world(), whole, partition_cells(whole, test::world().size(), in_blocks));
    const CanonicalSlices slices(mesh);
    const Sharing<VertexIndex> sharing = find_vertex_sharing(mesh);
    ASSERT_TRUE(slices.facts().has_point_markers);
    const std::vector<Field> fields{
        {"u", FieldOn::vertices, 2, std::vector<double>(2 * mesh.points.size(), 1.5)},
        {"n", FieldOn::cells, 1, std::vector<std::int32_t>(mesh.cells.size(), 7)}};
    const std::uint64_t failures = fail_each_allocation([&] {
        test::world().transaction([&] {
            OwnPiece piece(mesh, slices.lists(), slices.numbers(), slices.facts());
            piece.add(fields, sharing);
        });
    });
    EXPECT_GE(failures, 20U);
}

/// The process that reads distributes what it has read; an entry that it could not pack must not be
/// taken for data.
TEST(FailingAllocations, OfTheProcessThatReadsForTheVerifierAreThrownOnAll) {
    const Communicator& world = test::world();
    const test::SharedFolder folder;
    const std::filesystem::path file = folder / "m.mesh";
    world.on_first(
        [&] { (void)write_mesh(test::marked(test::perturbed_kuhn(2, 0.2, 1), 1), file); });
    test::refuses_only_one = true;
    std::uint64_t failures = 0;
    for (long allocations = 1;; ++allocations) {  // the first is needed to send at all
        if (world.is_first()) allocations_left = allocations;
        std::string said;
        try {
            (void)verify::read_slice(file, {}, world);
        } catch (const std::exception& error) {
            said = error.what();
        }
        const bool refused_here = std::exchange(allocations_left, never) == never;
        const bool was_refused = world.of_first(std::uint64_t{refused_here}) != 0;
        const std::uint64_t failed_on = world.sum(said.empty() ? 0 : 1);
        ASSERT_TRUE(failed_on == 0 || failed_on == static_cast<std::uint64_t>(world.size()));
        if (failed_on > 0) {
            ++failures;
            EXPECT_NE(said.find("memory"), std::string::npos) << said;
        }
        if (!was_refused) break;
    }
    test::refuses_only_one = false;
    EXPECT_GE(failures, 10U);
}

/// Messages that are divided into pieces, and that one process cannot store.
TEST(FailingAllocations, OfAReceiverOfLongMessagesBlockNoProcess) {
    const Communicator& world = test::world();
    std::vector<std::vector<std::uint64_t>> outboxes;
    for (int r = 0; r < world.size(); ++r) {
        outboxes.emplace_back(300'000U * static_cast<std::size_t>(r + 1), 7U);
    }
    for (int rank = 0; rank < world.size(); ++rank) {
        for (long allocations = 0;; ++allocations) {
            const bool done = try_work(allocations, rank, [&] {
                for (const auto& inbox : world.all_to_all(outboxes)) {
                    EXPECT_TRUE(inbox.empty() || inbox.front() + inbox.back() == 14U);
                }
            });
            EXPECT_TRUE(done || world.rank() == rank);
            if (world.sum(done ? 1 : 0) == static_cast<std::uint64_t>(world.size())) break;
        }
    }
    const auto inboxes = world.all_to_all(outboxes);
    for (const auto& inbox : inboxes) {
        EXPECT_EQ(inbox, outboxes[static_cast<std::size_t>(world.rank())]);
    }
}

}  // namespace
}  // namespace octetra::distributed
