#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>

namespace octetra::rivals {

/// The index in cell_edges of the longest edge of a cell, in the strict order.
inline std::uint8_t longest_edge(const Corners& corners) {
    const auto segment = [&](std::size_t edge) {
        const auto& [i, j] = cell_edges[edge];
        return Segment{corners[i], corners[j]};
    };
    std::array<double, 6> squares;
    for (std::size_t e = 0; e < 6; ++e) squares[e] = squared_length(segment(e));
    std::size_t best = 0;
    for (std::size_t e = 1; e < 6; ++e) {
        if (squares[e] > squares[best]) best = e;
    }
    // If half of the greatest square is in the range of reliable comparisons, a square below this
    // range is certainly smaller.
    const bool is_sure = is_sure_square(squares[best] / 2) && is_sure_square(squares[best]);
    if (!is_sure || std::ranges::count(squares, squares[best]) > 1) {
        best = 0;
        for (std::size_t e = 1; e < 6; ++e) {
            if (longer(segment(e), segment(best))) best = e;
        }
    }
    return static_cast<std::uint8_t>(best);
}

}  // namespace octetra::rivals
