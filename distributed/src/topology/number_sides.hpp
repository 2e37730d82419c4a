#pragma once

#include <span>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sides.hpp>

#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// Collective. Numbers the edges, or faces, of a mesh whose vertices have these numbers;
/// `shared_vertices` are those that other processes also have, ascending. Throws InputError if
/// 32-bit numbers cannot represent the sides of one process.
[[nodiscard]] MeshEdges number_edges(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                                     std::span<const VertexIndex> shared_vertices);
[[nodiscard]] MeshFaces number_faces(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                                     std::span<const VertexIndex> shared_vertices);

}  // namespace octetra::distributed
