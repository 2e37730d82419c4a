#pragma once

#include <array>

#include <octetra/core/point.hpp>
#include <octetra/core/selection.hpp>

/// Sizes and angles of triangles and tetrahedra, in binary64. Angles are in degrees, computed from
/// sine and cosine together, so that angles near 0 and 180 are as accurate as others.
namespace octetra {

using Triangle = std::array<Point, 3>;

[[nodiscard]] double distance(const Point& a, const Point& b);

[[nodiscard]] double area(const Triangle& triangle);

/// Returns the angle at each corner.
[[nodiscard]] std::array<double, 3> corner_angles(const Triangle& triangle);

/// Returns the interior angle between the two faces at each edge, in the order of cell_edges.
/// Independent of the orientation. All angles of a flat cell are 0 or 180.
[[nodiscard]] std::array<double, 6> dihedral_angles(const Corners& corners);

/// Returns the mean ratio eta: eta^3 = 432 D^2 / S^3, with D six times the volume and S the sum of
/// the six squared edge lengths. 1 for a regular tetrahedron, 0 for a flat one; invariant under
/// similarity. (Liu & Joe 1994.)
[[nodiscard]] double mean_ratio(const Corners& corners);

}  // namespace octetra
