#pragma once

#include <array>

#include "pattern/patterns.hpp"

namespace octetra::distributed {

/// How a cell's children by fewer edges are made up of those by more.
struct CoarserPattern {
    static constexpr std::uint8_t none = 255;
    std::uint8_t child_count = 0;  ///< by fewer edges; 1 where there are none
    /// For each child by more edges, the child by fewer that it lies in.
    std::array<std::uint8_t, 8> child_around{};
    /// And how often that was halved for it.
    std::array<std::uint8_t, 8> halvings{};
    /// For each child by fewer edges, the same child by more, or none where it is cut there. It is
    /// the same to the order of its vertices.
    std::array<std::uint8_t, 8> same_child{};
};

/// Of a cell in this order of lengths. Both sets of edges are closed, and `fewer` is within `more`,
/// which is not empty.
[[nodiscard]] CoarserPattern coarser_pattern(LengthOrder order, EdgeMask more, EdgeMask fewer);

}  // namespace octetra::distributed
