#pragma once

#include <cstdint>

namespace octetra::generator {

struct Direction {
    double cos = 1;
    double sin = 0;
};

/// Returns the direction after `step` of `steps` equal parts of a full turn.
[[nodiscard]] Direction direction(double step, double steps);

/// Returns the number of parts, at least `least`, into which a circle must be divided to have sides
/// no longer than `edge_length`.
[[nodiscard]] std::uint32_t circle_parts(double radius, double edge_length, std::uint32_t least);

}  // namespace octetra::generator
