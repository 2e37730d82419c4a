#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <octetra/core/mesh_stretch.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/predicted_cells.hpp>

namespace octetra::distributed {

/// Can cells find their parts by this method while no process has all of them?
[[nodiscard]] inline bool works_by_stretches(PartitionMethod method) {
    return method == PartitionMethod::rcb || method == PartitionMethod::block;
}

/// Collective. Brings what processes have read of a mesh to its parts; no process takes more memory
/// than in proportion to its stretch and its part, and a sixth of a byte for each vertex of the
/// mesh. Judges what read_mesh() does: cells are positive, and no two have the same vertices; every
/// tagged facet and edge is of some cell, of no more than one on each side, and has one marker.
/// Returns nothing, on all processes, if that does not hold. Throws OutOfMemory, and what `weigh`
/// throws; see ReadPartsOptions.
[[nodiscard]] std::optional<DistributedMesh> distribute_stretch(
    const Communicator& processes, MeshStretch stretch, PartitionMethod method,
    const std::function<std::vector<float>(const CellsToWeigh&)>& weigh);

}  // namespace octetra::distributed
