#include <octetra/quality/shape.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/mesh.hpp>

namespace octetra::quality {
namespace {

Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

double dot(const Point& u, const Point& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }

Point cross(const Point& u, const Point& v) {
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

double norm(const Point& v) { return std::hypot(v.x, v.y, v.z); }

/// The angle whose sine and cosine have these values, up to a common positive factor.
double degrees(double sine, double cosine) {
    return std::atan2(sine, cosine) * (180 / std::numbers::pi);
}

Point times_power_of_two(const Point& p, int exponent) {
    return {std::scalbn(p.x, exponent), std::scalbn(p.y, exponent), std::scalbn(p.z, exponent)};
}

/// The largest difference of two of the points in a coordinate.
template <std::size_t N>
double extent_of(const std::array<Point, N>& points) {
    double extent = 0;
    for (const Point& p : points) {
        for (const Point& q : points) {
            const Point d = p - q;
            extent = std::max({extent, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        }
    }
    return extent;
}

/// Similar points whose largest coordinate difference is about 1, so that no product of lengths
/// overflows or vanishes. The factor is a power of two, so nothing is rounded.
template <std::size_t N>
std::array<Point, N> scaled(std::array<Point, N> points) {
    double extent = extent_of(points);
    if (!std::isfinite(extent)) {  // a quarter of it is
        for (Point& p : points) p = times_power_of_two(p, -2);
        extent = extent_of(points);
    }
    if (extent == 0) return points;
    const int exponent = -std::ilogb(extent);
    constexpr int far_from_one = 200;
    if (std::abs(exponent) > far_from_one) {  // then a coordinate that all have may overflow
        const Point origin = points[0];
        for (Point& p : points) p = p - origin;
    }
    for (Point& p : points) p = times_power_of_two(p, exponent);
    return points;
}

/// A normal of face i, twice its area long. With the order of cell_faces, normals 0 and 2 point to
/// one side of the cell (out of it, or into it), 1 and 3 to the other.
Point normal(const Corners& corners, std::size_t i) {
    const auto& [a, b, c] = cell_faces[i];
    return cross(corners[b] - corners[a], corners[c] - corners[a]);
}

}  // namespace

double distance(const Point& a, const Point& b) { return norm(a - b); }

double area(const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    return norm(cross(b - a, c - a)) / 2;
}

std::array<double, 3> corner_angles(const Triangle& triangle) {
    const auto [a, b, c] = scaled(triangle);
    const double twice_area = norm(cross(b - a, c - a));  // the sines, times two side lengths
    return {degrees(twice_area, dot(b - a, c - a)), degrees(twice_area, dot(a - b, c - b)),
            degrees(twice_area, dot(a - c, b - c))};
}

std::array<double, 6> dihedral_angles(const Corners& corners) {
    const Corners unit = scaled(corners);
    const double six_volumes = 6 * volume(unit);
    const std::array<Point, 4> normals{normal(unit, 0), normal(unit, 1), normal(unit, 2),
                                       normal(unit, 3)};
    std::array<double, 6> angles{};
    for (std::size_t k = 0; k < 6; ++k) {
        // The faces at edge k lie opposite the two corners that it does not have: edge 5 - k.
        const auto& [i, j] = cell_edges[k];
        const auto& [f, g] = cell_edges[5 - k];
        // Edge e with faces e x p and e x q: (e x p) x (e x q) = e (e . p x q), whose length is the
        // edge's times six volumes. The cosine's sign is as both normals point out, or not.
        const double sine = distance(unit[i], unit[j]) * six_volumes;
        const double product = dot(normals[f], normals[g]);
        const bool same_side = (f + g) % 2 == 0;
        angles[k] = degrees(sine, same_side ? -product : product);
    }
    return angles;
}

double mean_ratio(const Corners& corners) {
    const Corners unit = scaled(corners);
    double squares = 0;
    for (const auto& [i, j] : cell_edges) squares += squared_length({unit[i], unit[j]});
    if (!(squares > 0)) return 0;
    const double root = std::cbrt(6 * volume(unit));
    return std::min(1.0, std::cbrt(432.0) * root * root / squares);
}

}  // namespace octetra::quality
