#pragma once

#include <cstdint>
#include <span>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sharing.hpp>

namespace octetra::distributed {

/// Collective. Finds the sharers of the vertices of a mesh without levels.
/// Refinement never changes the ranks that have a vertex; it only adds midpoints of shared edges.
/// `may_be_shared` states for each local vertex whether another process has it, if that is known;
/// empty if not.
[[nodiscard]] Sharing<VertexIndex> find_vertex_sharing(
    const DistributedMesh& mesh, std::span<const std::uint8_t> may_be_shared = {});

}  // namespace octetra::distributed
