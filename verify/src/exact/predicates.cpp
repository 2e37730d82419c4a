#include "exact/predicates.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Segment_3.h>
#include <CGAL/Triangle_3.h>
#include <CGAL/intersections.h>

#include "exact/near_one.hpp"

namespace octetra::verify::exact {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Intervals = Kernel::Approximate_kernel;
using Rationals = Kernel::Exact_kernel;

template <class K>
typename K::Point_3 point(const Point& p) {
    using Number = typename K::FT;
    return {Number(p.x), Number(p.y), Number(p.z)};
}

/// Returns nothing, and counts nothing, if neither floating point nor intervals decide.
/// Precondition: rounding is upward.
std::optional<int> certain_orientation(const Point& a, const Point& b, const Point& c,
                                       const Point& d, Arithmetic& arithmetic) {
    if (const auto sign = clear_orientation(a, b, c, d)) {
        ++arithmetic.filtered;
        return sign;
    }
    const auto sign = Intervals::Orientation_3()(point<Intervals>(a), point<Intervals>(b),
                                                 point<Intervals>(c), point<Intervals>(d));
    if (!CGAL::is_certain(sign)) return std::nullopt;
    ++arithmetic.filtered;
    return static_cast<int>(CGAL::get_certain(sign));
}

int rational_orientation(const Point& a, const Point& b, const Point& c, const Point& d,
                         Arithmetic& arithmetic) {
    ++arithmetic.exact;
    return static_cast<int>(Rationals::Orientation_3()(point<Rationals>(a), point<Rationals>(b),
                                                       point<Rationals>(c), point<Rationals>(d)));
}

/// Precondition: the points are near 1.
int orientation_near_one(const Point& a, const Point& b, const Point& c, const Point& d,
                         Arithmetic& arithmetic) {
    if (const auto sign = clear_orientation(a, b, c, d)) {
        ++arithmetic.filtered;
        return *sign;
    }
    {
        const CGAL::Protect_FPU_rounding<true> upward;
        if (const auto sign = certain_orientation(a, b, c, d, arithmetic)) return *sign;
    }
    return rational_orientation(a, b, c, d, arithmetic);
}

/// Returns whether the line of the segment passes two sides of the triangle on different sides.
/// This also decides if an end of the segment lies in the plane. Precondition: rounding is upward.
bool line_certainly_misses(const std::array<Point, 2>& segment,
                           const std::array<Point, 3>& triangle) {
    Arithmetic ignored_counts;
    bool passes_left = false;
    bool passes_right = false;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto sign = certain_orientation(segment[0], segment[1], triangle[k],
                                              triangle[(k + 1) % 3], ignored_counts);
        passes_left = passes_left || sign == 1;
        passes_right = passes_right || sign == -1;
    }
    return passes_left && passes_right;
}

/// Returns an axis along which the projection of the triangle has nearly the largest area.
std::size_t best_axis(const std::array<Point, 3>& t) {
    const Point u{t[1].x - t[0].x, t[1].y - t[0].y, t[1].z - t[0].z};
    const Point v{t[2].x - t[0].x, t[2].y - t[0].y, t[2].z - t[0].z};
    const std::array<double, 3> areas{std::abs(u.y * v.z - u.z * v.y),
                                      std::abs(u.z * v.x - u.x * v.z),
                                      std::abs(u.x * v.y - u.y * v.x)};
    return static_cast<std::size_t>(std::max_element(areas.begin(), areas.end()) - areas.begin());
}

/// Returns whether, in the projection along an axis, a line through a side of one separates the
/// two. This decides most coplanar pairs, for which volumes do not. Precondition: rounding is
/// upward.
bool are_separated_in_projection(const std::array<Point, 2>& segment,
                                 const std::array<Point, 3>& triangle) {
    const std::size_t axis = best_axis(triangle);
    const auto seen = [axis](const Point& p) -> Intervals::Point_2 {
        if (axis == 0) return {p.y, p.z};
        if (axis == 1) return {p.z, p.x};
        return {p.x, p.y};
    };
    const std::array<Intervals::Point_2, 2> s{seen(segment[0]), seen(segment[1])};
    const std::array<Intervals::Point_2, 3> t{seen(triangle[0]), seen(triangle[1]),
                                              seen(triangle[2])};
    const auto are_clearly = [](int sign, const auto& from, const auto& to, const auto& points) {
        return std::all_of(points.begin(), points.end(), [&](const Intervals::Point_2& p) {
            const auto found = Intervals::Orientation_2()(from, to, p);
            return CGAL::is_certain(found) && static_cast<int>(CGAL::get_certain(found)) == sign;
        });
    };
    for (const int sign : {-1, 1}) {
        if (are_clearly(sign, s[0], s[1], t)) return true;
        if (!are_clearly(sign, t[0], t[1], std::array{t[2]})) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            if (are_clearly(-sign, t[k], t[(k + 1) % 3], s)) return true;
        }
    }
    return false;
}

/// Returns judge(a, b, c, d) of the corners, with p in the place of corner k.
auto with_p_as_corner(const std::array<Point, 4>& corners, std::size_t k, const Point& p,
                      auto&& judge) {
    std::array<Point, 4> at = corners;
    at[k] = p;
    return judge(at[0], at[1], at[2], at[3]);
}

int faces_touched_near_one(const std::array<Point, 4>& corners, const Point& p,
                           Arithmetic& arithmetic) {
    for (std::size_t k = 0; k < 4; ++k) {
        const auto sign = with_p_as_corner(corners, k, p, clear_orientation);
        if (sign != -1) continue;
        ++arithmetic.filtered;
        return -1;
    }
    std::array<std::optional<int>, 4> signs;
    {
        const CGAL::Protect_FPU_rounding<true> upward;
        for (std::size_t k = 0; k < 4; ++k) {
            signs[k] = with_p_as_corner(corners, k, p, [&](const auto&... points) {
                return certain_orientation(points..., arithmetic);
            });
            if (signs[k] == -1) return -1;
        }
    }
    int touched = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const int sign =
            signs[k] ? *signs[k] : with_p_as_corner(corners, k, p, [&](const auto&... points) {
                return rational_orientation(points..., arithmetic);
            });
        if (sign < 0) return -1;
        if (sign == 0) ++touched;
    }
    return touched;
}

bool meet_near_one(const std::array<Point, 2>& segment, const std::array<Point, 3>& triangle,
                   Arithmetic& arithmetic) {
    const auto& [p, q] = segment;
    const auto& [a, b, c] = triangle;
    if (const auto side = clear_orientation(a, b, c, p);
        side && side == clear_orientation(a, b, c, q)) {
        ++arithmetic.filtered;
        return false;
    }
    std::optional<int> clear_side_p;
    std::optional<int> clear_side_q;
    {
        const CGAL::Protect_FPU_rounding<true> upward;
        clear_side_p = certain_orientation(a, b, c, p, arithmetic);
        clear_side_q = certain_orientation(a, b, c, q, arithmetic);
        const std::optional<int> sides = clear_side_p && clear_side_q
                                             ? std::optional(*clear_side_p * *clear_side_q)
                                             : std::nullopt;
        if (sides == 1) return false;
        if (sides != -1 && (line_certainly_misses(segment, triangle) ||
                            are_separated_in_projection(segment, triangle))) {
            ++arithmetic.filtered;
            return false;
        }
    }
    const int side_p = clear_side_p ? *clear_side_p : rational_orientation(a, b, c, p, arithmetic);
    const int side_q = clear_side_q ? *clear_side_q : rational_orientation(a, b, c, q, arithmetic);
    if (side_p * side_q > 0) return false;
    if (side_p != 0 || side_q != 0) {
        // The segment meets the plane in one point, which is in the triangle unless the line of the
        // segment passes two sides of the triangle on different sides.
        const int ab = orientation_near_one(p, q, a, b, arithmetic);
        const int bc = orientation_near_one(p, q, b, c, arithmetic);
        const int ca = orientation_near_one(p, q, c, a, arithmetic);
        return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
    }
    ++arithmetic.exact;
    return CGAL::do_intersect(
        Rationals::Segment_3(point<Rationals>(p), point<Rationals>(q)),
        Rationals::Triangle_3(point<Rationals>(a), point<Rationals>(b), point<Rationals>(c)));
}

}  // namespace

std::optional<int> clear_orientation(const Point& a, const Point& b, const Point& c,
                                     const Point& d) {
    const Point u{b.x - a.x, b.y - a.y, b.z - a.z};
    const Point v{c.x - a.x, c.y - a.y, c.z - a.z};
    const Point w{d.x - a.x, d.y - a.y, d.z - a.z};
    const double vw = v.x * w.y;
    const double wv = w.x * v.y;
    const double wu = w.x * u.y;
    const double uw = u.x * w.y;
    const double uv = u.x * v.y;
    const double vu = v.x * u.y;
    const double value = u.z * (vw - wv) + v.z * (wu - uw) + w.z * (uv - vu);
    // The determinant is the sum of six products of three differences. Each product passes at most
    // eight roundings: three of differences, two of products, and three of sums. A rounding, in any
    // mode, is off by at most 2^-52 of its result, or by 2^-1074 if a product underflows; the
    // latter is then multiplied by an entry of the third column. The bound is twice as large, which
    // covers the products of errors and its own rounding, also down. If anything overflows, the
    // bound is infinite or NaN, and so it decides nothing.
    const double sizes = std::abs(u.z) * (std::abs(vw) + std::abs(wv)) +
                         std::abs(v.z) * (std::abs(wu) + std::abs(uw)) +
                         std::abs(w.z) * (std::abs(uv) + std::abs(vu));
    const double bound =
        0x1p-48 * sizes + 0x1p-1020 * (1 + std::abs(u.z) + std::abs(v.z) + std::abs(w.z));
    if (value > bound) return 1;
    if (value < -bound) return -1;
    return std::nullopt;
}

int orientation(const Point& a, const Point& b, const Point& c, const Point& d,
                Arithmetic& arithmetic) {
    if (are_near_one_by_axis(a, b, c, d)) return orientation_near_one(a, b, c, d, arithmetic);
    const auto [p, q, r, s] = near_one_by_axis<4>({a, b, c, d});
    return orientation_near_one(p, q, r, s, arithmetic);
}

int faces_touched(const std::array<Point, 4>& corners, const Point& p, Arithmetic& arithmetic) {
    const auto& [a, b, c, d] = corners;
    if (are_near_one_by_axis(a, b, c, d, p)) return faces_touched_near_one(corners, p, arithmetic);
    const auto [q, r, s, t, at] = near_one_by_axis<5>({a, b, c, d, p});
    return faces_touched_near_one({q, r, s, t}, at, arithmetic);
}

bool meet(const std::array<Point, 2>& segment, const std::array<Point, 3>& triangle,
          Arithmetic& arithmetic) {
    const auto& [p, q] = segment;
    const auto& [a, b, c] = triangle;
    if (are_near_one_by_axis(p, q, a, b, c)) return meet_near_one(segment, triangle, arithmetic);
    const auto [s, t, u, v, w] = near_one_by_axis<5>({p, q, a, b, c});
    return meet_near_one({s, t}, {u, v, w}, arithmetic);
}

}  // namespace octetra::verify::exact
