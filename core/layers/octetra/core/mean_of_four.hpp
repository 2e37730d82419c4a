#pragma once

namespace octetra {

/// The mean of four finite numbers, bitwise independent of their order, without overflow.
[[nodiscard]] double mean_of_four(double a, double b, double c, double d);

}  // namespace octetra
