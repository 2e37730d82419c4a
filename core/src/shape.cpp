#include <octetra/core/shape.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/mesh.hpp>

namespace octetra {
namespace {

Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

double dot(const Point& u, const Point& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }

Point cross(const Point& u, const Point& v) {
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

double norm(const Point& v) { return std::hypot(v.x, v.y, v.z); }

/// Returns the angle whose sine and cosine have these values, up to a common positive factor.
double degrees(double sine, double cosine) {
    return std::atan2(sine, cosine) * (180 / std::numbers::pi);
}

Point times_power_of_two(const Point& p, int exponent) {
    return {std::scalbn(p.x, exponent), std::scalbn(p.y, exponent), std::scalbn(p.z, exponent)};
}

/// Returns the largest difference of two of the points in any coordinate.
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

/// Returns similar points whose largest coordinate difference is about 1, so that no product of
/// lengths over- or underflows. The factor is a power of two, so nothing is rounded.
template <std::size_t N>
std::array<Point, N> scaled(std::array<Point, N> points) {
    double extent = extent_of(points);
    if (!std::isfinite(extent)) {  // but a quarter of it is finite
        for (Point& p : points) p = times_power_of_two(p, -2);
        extent = extent_of(points);
    }
    if (extent == 0) return points;
    const int exponent = -std::ilogb(extent);
    constexpr int far_from_one = 200;
    if (std::abs(exponent) > far_from_one) {  // a common offset of all points may overflow
        const Point origin = points[0];
        for (Point& p : points) p = p - origin;
    }
    for (Point& p : points) p = times_power_of_two(p, exponent);
    return points;
}

/// Returns a normal of face i whose length is twice its area. With the order of cell_faces, normals
/// 0 and 2 point to one side of the cell (outward or inward), 1 and 3 to the other.
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
        // The faces at edge k are opposite the two corners that are not its ends: those of edge 5 -
        // k.
        const auto& [i, j] = cell_edges[k];
        const auto& [f, g] = cell_edges[5 - k];
        // Edge e with faces e x p and e x q: (e x p) x (e x q) = e (e . p x q), whose length is
        // that of the edge times six volumes. The sign of the cosine depends on whether both
        // normals point to the same side.
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

}  // namespace octetra
