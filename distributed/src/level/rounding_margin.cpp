#include "level/rounding_margin.hpp"

#include <algorithm>
#include <cmath>

namespace octetra::distributed {
namespace {

double largest_coordinate(const Point& p) {
    return std::max(std::max(std::abs(p.x), std::abs(p.y)), std::abs(p.z));
}

Point difference(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

double determinant(const Point& u, const Point& v, const Point& w) {
    return u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) +
           u.z * (v.x * w.y - v.y * w.x);
}

}  // namespace

// Let s be the largest coordinate of the three edges from the first corner, m a bound on all
// coordinates of the corners, e = 2^-53, and D the determinant of those edges. The corners of a
// child are corners and midpoints of the cell, and the rounding error of a midpoint is at most e m.
// With exact midpoints the determinant of the child is at least D / 8, since a child is at most
// three bisections deep, and the coordinates of its edges are at most 2 s, twice those of the cell.
// Moving both ends of its edges by e m changes its determinant by at most 6 ((2 s + 2 e m)^3 - (2
// s)^3), which is less than 192 e m s^2 if s is larger than 8 e m; otherwise D is less than 6 s^3,
// and fails the test below anyway. The rounding error of the computed D is less than 100 e s^3.
// Together D > 1636 e m s^2 is sufficient, because s is less than m; the test requires 4096
// instead, which covers the rounding of the bound itself. Underflow is negligible compared to a
// bound above 2^-900; if the bound overflows, the comparison is false.
bool has_rounding_margin(const IndexVector<VertexIndex, Point>& points, const CellVertices& cell) {
    const Point& a = points[cell[0]];
    const Point u = difference(points[cell[1]], a);
    const Point v = difference(points[cell[2]], a);
    const Point w = difference(points[cell[3]], a);
    const double s =
        std::max(std::max(largest_coordinate(u), largest_coordinate(v)), largest_coordinate(w));
    const double m = largest_coordinate(a) + s;
    const double bound = 0x1p-41 * m * s * s;
    return bound > 0x1p-900 && determinant(u, v, w) > bound;
}

}  // namespace octetra::distributed
