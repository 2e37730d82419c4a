#pragma once

#include <numbers>

namespace octetra::generator {

/// Returns the volume of a regular cell.
[[nodiscard]] constexpr double regular_cell_volume(double edge_length) {
    return edge_length * edge_length * edge_length * std::numbers::sqrt2 / 12;
}

}  // namespace octetra::generator
