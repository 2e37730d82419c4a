#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include <octetra/core/selection.hpp>

/// Where a selection's spheres and boxes cannot mark a cell: most cells are far away from them,
/// which is found sooner than their centroids.
namespace octetra::distributed {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr Box empty_box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

inline void extend(Box& box, const Point& p) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
}

/// Could a cell whose corners are in the box be marked for its place, by a sphere or a box? Exact
/// in that it never denies what rounding would make core's marks() say.
[[nodiscard]] bool may_be_marked(const Selection& selection, const Box& corners);

/// The smallest box with these corners in it.
[[nodiscard]] Box box_of(const Corners& corners);

/// All that the spheres and boxes of a selection reach, from one corner to the other.
class SelectionBounds {
public:
    explicit SelectionBounds(const Selection& selection);

    /// The sides on which the point is beyond reach, a bit each: no cell is marked for its place
    /// whose corners have one in common.
    [[nodiscard]] std::uint8_t sides_beyond(const Point& p) const {
        const auto& [low, high] = reach_;
        const auto side = [](bool is_beyond, unsigned bit) {
            return static_cast<unsigned>(is_beyond) << bit;
        };
        return static_cast<std::uint8_t>(side(p.x < low.x, 0) | side(p.x > high.x, 1) |
                                         side(p.y < low.y, 2) | side(p.y > high.y, 3) |
                                         side(p.z < low.z, 4) | side(p.z > high.z, 5));
    }

    /// Do these corners of a cell have such a side in common?
    [[nodiscard]] bool is_out_of_reach(const Point& a, const Point& b, const Point& c,
                                       const Point& d) const {
        const auto is_beyond = [&](double Point::*x) {
            const double least = std::min(std::min(a.*x, b.*x), std::min(c.*x, d.*x));
            const double most = std::max(std::max(a.*x, b.*x), std::max(c.*x, d.*x));
            return static_cast<unsigned>(most < reach_.low.*x) |
                   static_cast<unsigned>(least > reach_.high.*x);
        };
        return (is_beyond(&Point::x) | is_beyond(&Point::y) | is_beyond(&Point::z)) != 0;
    }

    /// Of every cell whose corners are in the box, then.
    [[nodiscard]] bool is_out_of_reach(const Box& corners) const {
        const auto& [low, high] = corners;
        return high.x < reach_.low.x || low.x > reach_.high.x || high.y < reach_.low.y ||
               low.y > reach_.high.y || high.z < reach_.low.z || low.z > reach_.high.z;
    }

private:
    Box reach_ = empty_box;
};

}  // namespace octetra::distributed
