#pragma once

#include <array>
#include <optional>
#include <span>

#include <octetra/core/point.hpp>

#include "lookup/box_tree.hpp"

/// The surroundings of a vertex or edge as seen from there: entities that contain this apex are
/// cones of directions, and two that meet elsewhere have a common direction. Computed in floating
/// point with error bounds: either proves that two are disjoint, or leaves the question open.
namespace octetra::verify {

using Vector = std::array<double, 3>;

[[nodiscard]] inline double dot(const Vector& u, const Vector& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
[[nodiscard]] inline Vector cross(const Vector& u, const Vector& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
[[nodiscard]] inline Vector times(const Vector& u, double factor) {
    return {u[0] * factor, u[1] * factor, u[2] * factor};
}

/// An upper bound of the rounding errors of a few operations on numbers up to 1.
inline constexpr double few_roundings = 0x1p-48;

/// A unit vector with an error of at most `error` in each coordinate.
struct Direction {
    Vector unit{};
    double error = 0;

    [[nodiscard]] bool is_known() const { return error < 0.125; }
};

/// Computes directions of points from a vertex, on the sphere around it, or from an edge, on the
/// circle around its line.
class Viewpoint {
public:
    explicit Viewpoint(const Point& vertex) : origin_(vertex) {}
    Viewpoint(const Point& a, const Point& b);

    [[nodiscard]] Direction towards(const Point& p) const;

private:
    Point origin_;
    std::optional<Direction> axis_;
};

/// Returns a box around unit vectors, and so around their convex hull; all of space if one is
/// unknown.
[[nodiscard]] Bounds bounds_of_directions(std::span<const Direction> directions);

/// Returns a lower bound of the cosine between each ray and some common middle; 0 if a direction is
/// unknown or there is no such middle. A convex combination of the unit vectors is no shorter than
/// this.
[[nodiscard]] double least_cosine(std::span<const Direction> rays);

/// The cone spanned by the directions of up to three points.
class Cone {
public:
    explicit Cone(std::span<const Direction> rays);

    /// Returns true only if no direction of the cone leads to a point of the box other than 0.
    [[nodiscard]] bool misses(const Bounds& box) const;

private:
    [[nodiscard]] bool is_cut_off_by(const Vector& normal, const Bounds& box) const;
    void add_planes();

    std::array<Vector, 3> rays_{};
    std::size_t count_ = 0;
    double error_ = 0;
    /// The smallest cosine of the angle between a ray and their middle. It bounds the angle by
    /// which a plane must be tilted to have the whole cone on one side despite errors. 0 if the
    /// cone is too wide.
    double tightness_ = 0;
    std::array<Vector, 3> planes_{};  ///< normals; for two rays, one plane that contains both
    std::size_t plane_count_ = 0;
};

}  // namespace octetra::verify
