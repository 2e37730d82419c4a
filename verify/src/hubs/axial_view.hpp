#pragma once

#include <span>

#include "hubs/directions.hpp"

namespace octetra::verify {

/// Directions in cylindrical coordinates about an axis. Bounds hold an interval of angles
/// (component 0, in radians, which may exceed pi by part of a turn) and one of cosines with the
/// axis (component 1, scaled so that a BoxTree prefers to cut angles). If edges or faces surround
/// an axis, these boxes are small, unlike those in x, y and z, and comparing them is much cheaper
/// than Cone::misses().
class AxialView {
public:
    /// The axis is a unit vector; its accuracy affects only the cost.
    explicit AxialView(const Vector& axis);

    /// Returns the bounds of an entity for the tree. Entities near the axis get an unbounded
    /// interval, so that all others have a distance from it (see the source).
    [[nodiscard]] Bounds bounds_of_entity(std::span<const Direction> rays) const;

    /// Bounds to search for. meets() is true for the bounds of every entity that has a common
    /// direction with the convex cone of the rays.
    struct Wanted {
        Bounds bounds;
        [[nodiscard]] bool meets(const Bounds& entity) const;
    };
    [[nodiscard]] Wanted wanted(std::span<const Direction> rays) const;

private:
    [[nodiscard]] Bounds bounds_of(std::span<const Direction> rays, double least_radius,
                                   bool may_touch_axis) const;

    Vector axis_;
    Vector first_;   ///< perpendicular to the axis: angle 0
    Vector second_;  ///< perpendicular to both
};

}  // namespace octetra::verify
