#pragma once

#include <vector>

#include <octetra/distributed/adaptation.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "coarsen/coarser_part.hpp"
#include "coarsen/kept_vertices.hpp"

namespace octetra::distributed {

/// Returns the vertices of this process that are removed, of the mesh before their removal.
/// `in_place`: the cells of the mesh have the numbers that part.cells uses. Not collective.
[[nodiscard]] std::vector<RemovedVertex> removed_vertices(const DistributedMesh& mesh,
                                                          const KeptVertices& kept,
                                                          const CoarserPart& part, bool in_place);

}  // namespace octetra::distributed
