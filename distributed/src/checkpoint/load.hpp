#pragma once

#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/mesh_part.hpp>
#include <octetra/distributed/partition.hpp>

#include "history/cut_roots.hpp"

namespace octetra::distributed {

/// The part of a checkpoint that a process has.
struct LoadedPart {
    MeshPart input;  ///< its cells ascend by number
    CutRoots cuts;
    SharedFeatures features;  ///< see DistributedMesh
};

/// Collective. Every process reads its share of the blocks; then cells are sent to the ranks that
/// the partition assigns, with their patterns. The method rcb needs only a share and a part on each
/// process; for other methods, the first process reads the whole input. The weight of a cell is the
/// number of its descendants. Throws as AdaptiveMesh::load().
[[nodiscard]] LoadedPart load_part(const Communicator& processes, const CheckpointReader& file,
                                   const std::filesystem::path& path, const Partition& partition);

}  // namespace octetra::distributed
