#pragma once

#include <algorithm>
#include <cmath>

#include <octetra/core/selection.hpp>

namespace octetra::rivals {

/// volume(corners) > limit, without the operations that make the volume independent of the order of
/// the corners, unless they affect the result.
inline bool is_larger(const Corners& corners, double limit) {
    const auto& [a, b, c, d] = corners;
    const Point u{b.x - a.x, b.y - a.y, b.z - a.z};
    const Point v{c.x - a.x, c.y - a.y, c.z - a.z};
    const Point w{d.x - a.x, d.y - a.y, d.z - a.z};
    const double determinant = u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) +
                               u.z * (v.x * w.y - v.y * w.x);
    const double size =
        std::max({std::abs(u.x), std::abs(u.y), std::abs(u.z), std::abs(v.x), std::abs(v.y),
                  std::abs(v.z), std::abs(w.x), std::abs(w.y), std::abs(w.z)});
    constexpr double more_than_rounding = 1e-13;
    const double doubt = more_than_rounding * (size * size * size);
    const double excess = std::abs(determinant) / 6 - limit;
    if (doubt > 1e-290 && std::abs(excess) > doubt) return excess > 0;
    return volume(corners) > limit;
}

}  // namespace octetra::rivals
