#pragma once

#include <vector>

#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/mesh_part.hpp>
#include <octetra/distributed/partition.hpp>

namespace octetra::distributed {

/// What steps did to a process's cells of the input, which go by their places.
struct CutRoots {
    struct Root {
        std::uint32_t place = 0;
        std::uint32_t bytes = 0;
    };
    std::vector<Root> roots;          ///< those that were cut at all
    std::vector<std::uint8_t> bytes;  ///< what was done to one, and then the next: see RootBytes
};

/// What a process has of a checkpoint.
struct LoadedPart {
    MeshPart input;  ///< its cells ascend by number
    CutRoots cuts;
};

/// Collective. Every process reads its share of the blocks; then cells go where the partition gives
/// them, with what the steps did to them. Of the methods of partition, rcb works without any
/// process having more than its share and its part; for the others the first one reads the whole
/// input. Cells weigh as many as they have become. Throws as AdaptiveMesh::load().
[[nodiscard]] LoadedPart load_part(const Communicator& processes, const CheckpointReader& file,
                                   const std::filesystem::path& path, const Partition& partition);

}  // namespace octetra::distributed
