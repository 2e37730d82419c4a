#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <octetra/core/mesh_share.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/predicted_cells.hpp>

namespace octetra::distributed {

/// Returns whether the method can partition cells that no process has entirely.
[[nodiscard]] inline bool supports_shares(PartitionMethod method) {
    return method == PartitionMethod::rcb || method == PartitionMethod::block;
}

/// Collective, within a transaction. Distributes the shares of a mesh that processes have read to
/// its parts. The memory of a process is proportional to its share and its part, plus three
/// sixteenths of a byte for each vertex of the mesh. Checks the same conditions as read_mesh():
/// cells are positive, and no two have the same vertices; every tagged facet and edge belongs to a
/// cell, a facet to at most one on each side, and has one marker. Returns nothing on all processes
/// if one of them does not hold. Throws OutOfMemory, and exceptions of `weigh`; see
/// ReadPartsOptions.
///
/// A process fetches the corners of its cells from the processes that have read them, determines
/// orientations and centroids, and sends the cells to their parts. Vertices follow the cells. A
/// tagged facet or edge is sent to the owner of its lowest vertex in the OwnerMap, and from there
/// to all processes that have requested this vertex. These report on which sides they have cells;
/// the owner checks the reports and chooses the process that keeps the facet or edge. Cells with
/// equal vertices are either in one part, where a local search finds them, or have all their
/// vertices in two parts; a rendezvous compares the few cells of this kind.
[[nodiscard]] std::optional<DistributedMesh> distribute_share(
    const Communicator& processes, MeshShare share, PartitionMethod method,
    const std::function<std::vector<float>(const CellsToWeigh&)>& weigh);

}  // namespace octetra::distributed
