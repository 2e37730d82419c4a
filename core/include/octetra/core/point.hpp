#pragma once

#include <cmath>
#include <compare>

namespace octetra {

/// A position in space. Coordinates of a mesh are finite; the functions here do not check.
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

/// (a + b) / 2 in every coordinate, rounded as IEEE binary64 rounds. midpoint(a, b) and
/// midpoint(b, a) are the same bits, so every process that bisects the edge finds the same point.
[[nodiscard]] constexpr Point midpoint(const Point& a, const Point& b) {
    return {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
}

}  // namespace octetra
