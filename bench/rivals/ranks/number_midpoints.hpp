#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/process_group.hpp>

namespace octetra::rivals {

/// Collective. Gives this rank's midpoints the numbers that TerminalEdgeMesh says, level by level:
/// a rank that the ends of an edge determine numbers its midpoint, whoever has it. Appended to the
/// numbers of the input's vertices, of which the whole mesh has so many.
void number_midpoints(const ProcessGroup& ranks, std::uint64_t input_points,
                      const std::vector<EdgeVertices>& midpoint_to_edge,
                      IndexVector<VertexIndex, std::uint64_t>& numbers);

}  // namespace octetra::rivals
