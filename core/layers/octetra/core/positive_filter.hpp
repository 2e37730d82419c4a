#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include <octetra/core/point.hpp>

namespace octetra {

/// Confirms nearly every positive tetrahedron of a mesh, faster than orientation(): the error bound
/// of the determinant is computed once, for the bounding box of all points, instead of for each
/// tetrahedron.
class PositiveFilter {
public:
    /// Adds points that may be corners.
    void add(std::span<const Point> points) {
        for (const Point& p : points) {
            const std::array<double, 3> x{p.x, p.y, p.z};
            for (std::size_t k = 0; k < 3; ++k) {
                low_[k] = std::min(low_[k], x[k]);
                high_[k] = std::max(high_[k], x[k]);
            }
        }
        point_count_ += points.size();
        bound_ = bound();
    }
    [[nodiscard]] std::size_t point_count() const { return point_count_; }

    /// If the result is false, the orientation is undetermined; use orientation().
    [[nodiscard]] bool is_surely_positive(const Point& a, const Point& b, const Point& c,
                                          const Point& d) const {
        const Point u{b.x - a.x, b.y - a.y, b.z - a.z};
        const Point v{c.x - a.x, c.y - a.y, c.z - a.z};
        const Point w{d.x - a.x, d.y - a.y, d.z - a.z};
        return u.z * (v.x * w.y - w.x * v.y) + v.z * (w.x * u.y - u.x * w.y) +
                   w.z * (u.x * v.y - v.x * u.y) >
               bound_;
    }

private:
    // The determinant has six terms of three factors, none larger than the box. Each term passes
    // through at most 8 roundings, so the error is at most 8 * 6 * 2^-53 times the volume of the
    // box, up to higher orders; 64 * 2^-53 covers those and the rounding of the volume. A product
    // that underflows adds at most 2^-1075, which may be multiplied by a height. On overflow the
    // bound is infinite or NaN, and no cell is confirmed.
    [[nodiscard]] double bound() const {
        const double height = high_[2] - low_[2];
        const double volume = (high_[0] - low_[0]) * (high_[1] - low_[1]) * height;
        return 0x1p-47 * volume + 0x1p-1022 * (1 + 3 * height);
    }

    static constexpr double infinity = std::numeric_limits<double>::infinity();

    std::array<double, 3> low_{infinity, infinity, infinity};
    std::array<double, 3> high_{-infinity, -infinity, -infinity};
    double bound_ = infinity;
    std::size_t point_count_ = 0;
};

}  // namespace octetra
