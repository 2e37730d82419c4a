#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include <octetra/core/selection.hpp>

/// Conservative tests for the spheres and boxes of a selection: most cells are far away from them,
/// which is determined at less cost than their centroids.
namespace octetra::distributed {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr Box empty_box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

inline void extend(Box& box, const Point& p) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
}

/// Returns whether a sphere or box could mark a cell whose corners are in the box `corners`.
/// Conservative: never false for a cell that marks() of core, with its rounding, would mark.
[[nodiscard]] bool may_be_marked(const Selection& selection, const Box& corners);

/// Returns the bounding box of the corners.
[[nodiscard]] inline Box box_of(const Corners& corners) {
    Box box = empty_box;
    for (const Point& p : corners) extend(box, p);
    return box;
}

/// Tests with few comparisons that most cells are outside all spheres and boxes of a selection, or
/// inside a single one.
class SelectionBounds {
public:
    explicit SelectionBounds(const Selection& selection);

    /// Returns a bit for each side on which the point is beyond all spheres and boxes. A cell whose
    /// corners have a common bit is not marked by a sphere or box.
    [[nodiscard]] std::uint8_t sides_beyond(const Point& p) const {
        const auto& [low, high] = reach_;
        const auto side = [](bool is_beyond, unsigned bit) {
            return static_cast<unsigned>(is_beyond) << bit;
        };
        return static_cast<std::uint8_t>(side(p.x < low.x, 0) | side(p.x > high.x, 1) |
                                         side(p.y < low.y, 2) | side(p.y > high.y, 3) |
                                         side(p.z < low.z, 4) | side(p.z > high.z, 5));
    }

    /// Returns true only if no sphere or box marks any cell with corners in the box.
    [[nodiscard]] bool is_out_of_reach(const Box& corners) const {
        const auto& [low, high] = corners;
        return high.x < reach_.low.x || low.x > reach_.high.x || high.y < reach_.low.y ||
               low.y > reach_.high.y || high.z < reach_.low.z || low.z > reach_.high.z;
    }

    /// Returns true only if every such cell is marked, because a single sphere or box contains the
    /// box. Returns false if only several together contain it, or if rounding might decide.
    [[nodiscard]] bool is_wholly_inside(const Box& corners) const {
        const Point& low = corners.low;
        const Point& high = corners.high;
        for (const auto& [centre, squared_radius] : balls_) {
            const double dx = std::max(centre.x - low.x, high.x - centre.x);
            const double dy = std::max(centre.y - low.y, high.y - centre.y);
            const double dz = std::max(centre.z - low.z, high.z - centre.z);
            if (dx * dx + dy * dy + dz * dz < squared_radius) return true;
        }
        return std::ranges::any_of(boxes_, [&](const Box& box) {
            return low.x >= box.low.x && high.x <= box.high.x && low.y >= box.low.y &&
                   high.y <= box.high.y && low.z >= box.low.z && high.z <= box.high.z;
        });
    }

private:
    struct Ball {
        Point centre;
        double squared_radius;
    };

    Box reach_ = empty_box;
    std::vector<Ball> balls_;  ///< the spheres with slightly reduced radii
    std::vector<Box> boxes_;
};

}  // namespace octetra::distributed
