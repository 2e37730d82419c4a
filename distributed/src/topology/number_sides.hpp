#pragma once

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sides.hpp>

#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// Collective. The edges, or faces, of a mesh whose vertices have these numbers. Throws alike on
/// all processes: InputError where 32 bits cannot number those of one process.
[[nodiscard]] MeshEdges number_edges(const DistributedMesh& mesh, const CanonicalNumbers& numbers);
[[nodiscard]] MeshFaces number_faces(const DistributedMesh& mesh, const CanonicalNumbers& numbers);

}  // namespace octetra::distributed
