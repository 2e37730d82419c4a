#pragma once

#include <array>
#include <optional>
#include <span>

#include <octetra/core/point.hpp>

#include "lookup/box_tree.hpp"

/// What lies round a vertex, or round an edge, seen from there: entities that have this apex in
/// common are cones of directions, and two that meet elsewhere have a direction in common. All of
/// it is floating point that knows its error: it says for certain that things are apart, or it
/// leaves the question open.
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

/// More than the rounding errors of a few operations on numbers up to 1.
inline constexpr double few_roundings = 0x1p-48;

/// A unit vector, to within `error` in each coordinate.
struct Direction {
    Vector unit{};
    double error = 0;

    [[nodiscard]] bool is_known() const { return error < 0.125; }
};

/// Looks at points from a vertex: where they lie on the sphere round it. From an edge: where they
/// lie on the circle round its line.
class Viewpoint {
public:
    explicit Viewpoint(const Point& vertex) : origin_(vertex) {}
    Viewpoint(const Point& a, const Point& b);

    [[nodiscard]] Direction towards(const Point& p) const;

private:
    Point origin_;
    std::optional<Direction> axis_;
};

/// A box around unit vectors, and so around what lies between them on straight lines. All of space
/// where one is not known.
[[nodiscard]] Bounds bounds_of_directions(std::span<const Direction> directions);

/// A lower bound of the cosine between each ray and some middle of all; 0 if a direction is unknown
/// or there is no such middle. A convex combination of the unit vectors is no shorter than that.
[[nodiscard]] double least_cosine(std::span<const Direction> rays);

/// All that lies in the directions of up to three points, and between these.
class Cone {
public:
    explicit Cone(std::span<const Direction> rays);

    /// For certain: no direction is one that leads to a point of the box other than 0.
    [[nodiscard]] bool misses(const Bounds& box) const;

private:
    [[nodiscard]] bool is_cut_off_by(const Vector& normal, const Bounds& box) const;
    void add_planes();

    std::array<Vector, 3> rays_{};
    std::size_t count_ = 0;
    double error_ = 0;
    /// Least cosine of the angle between a ray and a middle of them, which makes up for errors:
    /// planes are tilted by no more than these to have the whole cone on one side. 0: it is too
    /// wide.
    double tightness_ = 0;
    std::array<Vector, 3> planes_{};  ///< normals: of two rays, one plane that has both
    std::size_t plane_count_ = 0;
};

}  // namespace octetra::verify
