#include "measures/rounded_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "exact/vectors.hpp"

namespace octetra::verify {
namespace {

using BoundVector = exact::Vector<Bound>;
using exact::cross, exact::dot;

BoundVector edge_from(const Point& a, const Point& b) { return exact::between<Bound>(a, b); }

Bound length_of(const BoundVector& v) { return std::sqrt(dot(v, v)); }

/// An upper bound of six times the volume with exact midpoints. It deviates by at most
/// volume_bound(), and by at most 2^-58 L^3 in this computation, where L is the longest edge.
Bound six_volumes_at_most(const Shape<4>& shape) {
    const auto& [o, p, q, r] = shape.corners;
    const Bound volume = dot(edge_from(o, p), cross(edge_from(o, q), edge_from(o, r)));
    const Bound longest = shape.longest_edge();
    return volume + volume_bound(shape) + 0x1p-58L * longest * longest * longest;
}

}  // namespace

/// A normal, as the cross product of two edges, deviates by at most 2 e (L + e), where e is the
/// error of an edge, and L the longest edge; so it turns by at most the arc sine of the ratio of
/// this to its length, which is less than pi / 2 times the ratio. A dihedral angle is that between
/// two normals.
double dihedral_error(const Shape<4>& shape) {
    Bound least_normal = std::numeric_limits<Bound>::infinity();
    for (const auto& [a, b, c] : cell_faces) {
        const Point& from = shape.corners[a];
        const BoundVector normal =
            cross(edge_from(from, shape.corners[b]), edge_from(from, shape.corners[c]));
        least_normal = std::min(least_normal, length_of(normal));
    }
    const Bound turned = 2 * shape.edge_error() * (shape.longest_edge() + shape.edge_error());
    return static_cast<double>(2 * 90 * turned / least_normal * up);
}

/// A squared length deviates by at most e (2 L + e).
double exact_mean_ratio_at_most(const Shape<4>& shape) {
    Bound squares = 0;
    for (const auto& [i, j] : cell_edges) {
        const BoundVector edge = edge_from(shape.corners[i], shape.corners[j]);
        squares += dot(edge, edge);
    }
    const Bound error = shape.edge_error();
    const Bound least = squares - 6 * error * (2 * shape.longest_edge() + error) * up;
    if (least <= 0) return 1;
    const Bound half = six_volumes_at_most(shape) / 2;
    return static_cast<double>(12 * std::cbrt(half * half) / least * up);
}

/// Van Oosterom and Strackee (doi 10.1109/TBME.1983.325207): the tangent of half the solid angle
/// between vectors u, v, w is their determinant divided by |u| |v| |w| + (u.v) |w| + (u.w) |v| +
/// (v.w) |u|. Each of the four terms deviates by at most 3 e (L + e)^2, as a determinant does, and
/// their sum by at most 2^-57 L^3 in this computation.
bool solid_angles_may_reach(double least, const Shape<4>& shape) {
    const auto& p = shape.corners;
    const Bound volume = six_volumes_at_most(shape);
    const Bound tangent = std::tan(Bound{least} / 2);
    const Bound longest = shape.longest_edge();
    const Bound error = 4 * volume_bound(shape) + 0x1p-57L * longest * longest * longest;
    for (std::size_t k = 0; k < 4; ++k) {
        const BoundVector u = edge_from(p[k], p[(k + 1) % 4]);
        const BoundVector v = edge_from(p[k], p[(k + 2) % 4]);
        const BoundVector w = edge_from(p[k], p[(k + 3) % 4]);
        const Bound sum = length_of(u) * length_of(v) * length_of(w) + dot(u, v) * length_of(w) +
                          dot(u, w) * length_of(v) + dot(v, w) * length_of(u);
        if (volume < tangent * (sum - error)) return false;
    }
    return true;
}

}  // namespace octetra::verify
