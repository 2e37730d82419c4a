#pragma once

#include <vector>

#include <octetra/distributed/adaptation.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "coarsen/coarser_part.hpp"
#include "coarsen/kept_vertices.hpp"

namespace octetra::distributed {

/// The vertices of this process that go, of the mesh as it is before they do. `in_place`: the cells
/// of the mesh have the numbers by which the succession of `part` names them. Not collective.
[[nodiscard]] std::vector<RemovedVertex> removed_vertices(const DistributedMesh& mesh,
                                                          const KeptVertices& kept,
                                                          const CoarserPart& part, bool in_place);

}  // namespace octetra::distributed
