#pragma once

#include <octetra/core/point.hpp>

namespace octetra {

/// Sign of the determinant | b-a  c-a  d-a |, six times the signed volume of the tetrahedron abcd:
/// +1 positively oriented (seen from d, the corners a, b, c run counterclockwise), -1 inverted, 0
/// flat. Exact for all finite coordinates. A floating-point filter decides almost all cases;
/// integers of arbitrary precision decide the rest. Swapping two arguments changes the sign.
[[nodiscard]] int orientation(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace octetra
