#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/process_group.hpp>
#include <octetra/verify/mesh_slice.hpp>

namespace octetra::verify {

/// Collective. Where some vertices of the whole mesh are, by their numbers, ascending.
[[nodiscard]] IndexVector<VertexIndex, Point> fetch_points(const std::vector<std::uint32_t>& wanted,
                                                           const MeshSlice& slice,
                                                           const ProcessGroup& group);

/// Collective. Puts vertices of the whole mesh, by their numbers, ascending, into a mesh that has
/// none, with markers and attributes.
void fetch_vertices(const std::vector<std::uint32_t>& wanted, const MeshSlice& slice,
                    const ProcessGroup& group, Mesh& mesh);

}  // namespace octetra::verify
