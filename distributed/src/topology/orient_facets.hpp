#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// The tagged facets of this process, oriented as AdaptiveMesh::oriented_facets() says. Not
/// collective.
[[nodiscard]] std::vector<FacetVertices> orient_facets(const DistributedMesh& mesh);

}  // namespace octetra::distributed
