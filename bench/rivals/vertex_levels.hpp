#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <octetra/core/index.hpp>
#include <octetra/core/mesh.hpp>

namespace octetra::rivals {

/// 0 for the input's vertices; for a midpoint, one above the higher level of its ends.
inline IndexVector<VertexIndex, std::uint32_t> vertex_levels(
    const std::vector<EdgeVertices>& midpoint_to_edge, std::size_t input_points) {
    IndexVector<VertexIndex, std::uint32_t> levels(input_points, 0U);
    levels.reserve(input_points + midpoint_to_edge.size());
    for (const auto& [a, b] : midpoint_to_edge) {
        levels.push_back(1 + std::max(levels[a], levels[b]));
    }
    return levels;
}

}  // namespace octetra::rivals
