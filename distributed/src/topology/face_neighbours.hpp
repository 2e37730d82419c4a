#pragma once

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sides.hpp>

namespace octetra::distributed {

/// Collective. What is behind each face of this process's cells.
[[nodiscard]] FaceNeighbours find_face_neighbours(const DistributedMesh& mesh);

/// The faces behind which nothing is, by cell. Not collective.
[[nodiscard]] std::vector<BoundaryFace> find_boundary(const DistributedMesh& mesh);

}  // namespace octetra::distributed
