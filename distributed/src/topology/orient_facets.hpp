#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Returns the tagged facets of this process, oriented as described at
/// AdaptiveMesh::oriented_facets(). Not collective.
[[nodiscard]] std::vector<FacetVertices> orient_facets(const DistributedMesh& mesh);

}  // namespace octetra::distributed
