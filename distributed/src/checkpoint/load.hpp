#pragma once

#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/mesh_part.hpp>
#include <octetra/distributed/partition.hpp>

#include "history/cut_roots.hpp"

namespace octetra::distributed {

/// What a process has of a checkpoint.
struct LoadedPart {
    MeshPart input;  ///< its cells ascend by number
    CutRoots cuts;
    SharedFeatures features;  ///< see DistributedMesh
};

/// Collective. Every process reads its share of the blocks; then cells go where the partition gives
/// them, with what the steps did to them. Of the methods of partition, rcb works without any
/// process having more than its share and its part; for the others the first one reads the whole
/// input. Cells weigh as many as they have become. Throws as AdaptiveMesh::load().
[[nodiscard]] LoadedPart load_part(const Communicator& processes, const CheckpointReader& file,
                                   const std::filesystem::path& path, const Partition& partition);

}  // namespace octetra::distributed
