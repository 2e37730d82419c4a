#pragma once

#include <array>

#include <octetra/core/point.hpp>
#include <octetra/verify/verdict.hpp>

namespace octetra::verify::exact {

/// Returns whether eta, the mean ratio of a cell, is less than this limit, from 0 to 1. The cube of
/// eta is 432 d^2 / s^3, with d six times the volume and s the sum of the squared lengths of the
/// edges, so no roots are needed. Precondition: the cell is positively oriented.
[[nodiscard]] bool is_mean_ratio_less(const std::array<Point, 4>& corners, double limit,
                                      Arithmetic& arithmetic);

}  // namespace octetra::verify::exact
