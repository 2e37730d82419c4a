#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/process_group.hpp>
#include <octetra/verify/mesh_slice.hpp>

namespace octetra::verify {

/// Collective. Returns the coordinates of vertices of the whole mesh, given their numbers,
/// ascending.
[[nodiscard]] IndexVector<VertexIndex, Point> fetch_points(const std::vector<std::uint32_t>& wanted,
                                                           const MeshSlice& slice,
                                                           const ProcessGroup& group);

/// Collective. Adds vertices of the whole mesh, given their numbers, ascending, to a mesh without
/// vertices, with markers and attributes.
void fetch_vertices(const std::vector<std::uint32_t>& wanted, const MeshSlice& slice,
                    const ProcessGroup& group, Mesh& mesh);

}  // namespace octetra::verify
