#pragma once

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sides.hpp>

namespace octetra::distributed {

/// Collective. Returns the neighbour through each face of this process's cells.
[[nodiscard]] FaceNeighbours find_face_neighbours(const DistributedMesh& mesh);

/// Returns the faces on the boundary of the whole mesh, ordered by cell. Not collective.
[[nodiscard]] std::vector<BoundaryFace> find_boundary(const DistributedMesh& mesh);

}  // namespace octetra::distributed
