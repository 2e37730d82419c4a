#pragma once

#include <cmath>
#include <compare>

namespace octetra {

/// A position in space. Coordinates of a mesh are finite; the functions here do not check this.
struct Point {
    double x = 0;
    double y = 0;
    double z = 0;

    /// Lexicographic by x, then y, then z. (-0.0 equals 0.0.)
    friend constexpr auto operator<=>(const Point&, const Point&) = default;
};

[[nodiscard]] inline bool is_finite(const Point& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Coordinates of a mesh are less than this in magnitude, so that no sum of two overflows.
inline constexpr double coordinate_limit = 0x1p+1023;

/// Computes (a + b) / 2 in every coordinate, rounded as IEEE binary64 rounds. midpoint(a, b) and
/// midpoint(b, a) are bitwise equal, so every process that bisects the edge computes the same
/// point.
[[nodiscard]] constexpr Point midpoint(const Point& a, const Point& b) {
    return {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
}

/// Computes (a + b) / 2 of any finite numbers, such as the attributes of two vertices, without
/// overflow.
[[nodiscard]] inline double mean(double a, double b) {
    const double sum = a + b;
    return std::isfinite(sum) ? sum / 2 : a / 2 + b / 2;
}

}  // namespace octetra
