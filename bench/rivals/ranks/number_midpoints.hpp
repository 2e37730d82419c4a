#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/process_group.hpp>

namespace octetra::rivals {

/// Collective. Appends to `vertex_numbers` the numbers of this rank's midpoints as defined by
/// TerminalEdgeMesh, level by level. A rendezvous rank determined by the ends of an edge numbers
/// its midpoint. The whole mesh has `input_points` vertices of the input.
void number_midpoints(const ProcessGroup& ranks, std::uint64_t input_points,
                      const std::vector<EdgeVertices>& midpoint_to_edge,
                      IndexVector<VertexIndex, std::uint64_t>& numbers);

}  // namespace octetra::rivals
