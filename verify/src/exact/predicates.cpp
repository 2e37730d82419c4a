#include "exact/predicates.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Segment_3.h>
#include <CGAL/Triangle_3.h>
#include <CGAL/intersections.h>

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

}  // namespace

std::optional<int> clear_orientation(const Point& a, const Point& b, const Point& c, const Point& d,
                                     Arithmetic& arithmetic) {
    const CGAL::Protect_FPU_rounding<true> upward;
    const auto sign = Intervals::Orientation_3()(point<Intervals>(a), point<Intervals>(b),
                                                 point<Intervals>(c), point<Intervals>(d));
    if (!CGAL::is_certain(sign)) return std::nullopt;
    ++arithmetic.filtered;
    return static_cast<int>(CGAL::get_certain(sign));
}

int orientation(const Point& a, const Point& b, const Point& c, const Point& d,
                Arithmetic& arithmetic) {
    if (const auto sign = clear_orientation(a, b, c, d, arithmetic)) return *sign;
    ++arithmetic.exact;
    return static_cast<int>(Rationals::Orientation_3()(point<Rationals>(a), point<Rationals>(b),
                                                       point<Rationals>(c), point<Rationals>(d)));
}

bool meet(const std::array<Point, 2>& segment, const std::array<Point, 3>& triangle,
          Arithmetic& arithmetic) {
    const auto& [p, q] = segment;
    const auto& [a, b, c] = triangle;
    const int side_p = orientation(a, b, c, p, arithmetic);
    const int side_q = orientation(a, b, c, q, arithmetic);
    if (side_p * side_q > 0) return false;
    if (side_p != 0 || side_q != 0) {
        // The segment reaches the plane in one point. It is in the triangle unless the line of the
        // segment passes two of its sides on different sides.
        const int ab = orientation(p, q, a, b, arithmetic);
        const int bc = orientation(p, q, b, c, arithmetic);
        const int ca = orientation(p, q, c, a, arithmetic);
        return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
    }
    ++arithmetic.exact;
    return CGAL::do_intersect(
        Rationals::Segment_3(point<Rationals>(p), point<Rationals>(q)),
        Rationals::Triangle_3(point<Rationals>(a), point<Rationals>(b), point<Rationals>(c)));
}

}  // namespace octetra::verify::exact
