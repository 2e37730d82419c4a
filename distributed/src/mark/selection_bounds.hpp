#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

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
[[nodiscard]] inline Box box_of(const Corners& corners) {
    Box box = empty_box;
    for (const Point& p : corners) extend(box, p);
    return box;
}

/// What is told in a few comparisons of most cells: that no sphere or box of a selection reaches
/// them, or that one of them has all of them in it.
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

    /// Can no cell be marked for its place whose corners are in the box?
    [[nodiscard]] bool is_out_of_reach(const Box& corners) const {
        const auto& [low, high] = corners;
        return high.x < reach_.low.x || low.x > reach_.high.x || high.y < reach_.low.y ||
               low.y > reach_.high.y || high.z < reach_.low.z || low.z > reach_.high.z;
    }

    /// Is every such cell marked, as the box is in one of the spheres or boxes? Says no where it is
    /// in the middle of several, or where rounding might decide.
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
    std::vector<Ball> balls_;  ///< the spheres, a little smaller
    std::vector<Box> boxes_;
};

}  // namespace octetra::distributed
