#include "commands/share_out.hpp"

#include <utility>

#include <octetra/distributed/profile.hpp>

namespace octetra::cli {

distributed::DistributedMesh share_out(
    Mesh mesh, const distributed::Partition& partition, const distributed::Communicator& world,
    const std::function<std::vector<float>(const Mesh&)>& weights) {
    std::vector<int> cell_to_rank;
    distributed::in_phase(world, "partition", [&] {
        world.on_first([&] {
            // A part file that does not fit is a mistake on one rank, too.
            const bool by_file = partition.method == distributed::PartitionMethod::file;
            if (world.size() == 1 && !by_file) return;
            cell_to_rank = distributed::partition_cells(
                mesh, world.size(), partition,
                takes_weights(partition) ? weights(mesh) : std::vector<float>{});
        });
    });
    return distributed::distribute(world, std::move(mesh), cell_to_rank);
}

}  // namespace octetra::cli
