#pragma once

#include <cstdint>

namespace octetra::generator {

struct Direction {
    double cos = 1;
    double sin = 0;
};

/// The direction after `step` of `steps` equal parts of a full turn.
[[nodiscard]] Direction direction(double step, double steps);

/// Into how many parts a circle must be cut to have sides no longer than `edge_length`; at least
/// `least`.
[[nodiscard]] std::uint32_t circle_parts(double radius, double edge_length, std::uint32_t least);

}  // namespace octetra::generator
