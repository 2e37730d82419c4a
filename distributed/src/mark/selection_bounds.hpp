#pragma once

#include <cstdint>
#include <limits>

#include <octetra/core/selection.hpp>

/// Where a selection's spheres and boxes cannot mark a cell: most cells are far away from them,
/// which is found sooner than their centroids.
namespace octetra::distributed {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr Box empty_box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

void extend(Box& box, const Point& p);

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
    [[nodiscard]] std::uint8_t sides_beyond(const Point& p) const;

private:
    Box centroids_ = empty_box;
};

}  // namespace octetra::distributed
