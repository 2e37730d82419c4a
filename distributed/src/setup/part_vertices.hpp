#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh_share.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "setup/owners.hpp"
#include "setup/vertex_set.hpp"

namespace octetra::distributed {

/// The vertices of a process's part: those of its cells, and those of its share of the file that no
/// cell of any process has.
struct VerticesOfPart {
    VertexSet set;
    Requests<std::uint32_t> requests;     ///< requests of all processes, by owner of the vertices
    std::vector<std::uint8_t> is_shared;  ///< whether another process has each vertex of the set
};

/// Collective, within a transaction. Finds the vertices of these cells, which have global vertex
/// numbers.
[[nodiscard]] VerticesOfPart find_vertices(const Communicator& processes, const OwnerMap& owners,
                                           const MeshShare& share,
                                           const IndexVector<CellIndex, CellVertices>& cells);

/// Collective, within a transaction. Fetches points, markers and attributes into the mesh.
void fetch_vertices(const Communicator& processes, const VerticesOfPart& vertices,
                    const MeshShare& share, DistributedMesh& mesh);

}  // namespace octetra::distributed
