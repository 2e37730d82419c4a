#pragma once

#include <array>

#include <octetra/core/point.hpp>
#include <octetra/verify/verdict.hpp>

/// Decisions by exact arithmetic: in intervals first, in rational numbers where those do not
/// decide. Each is counted as the one or the other. (CGAL stands behind them, and nowhere else.)
namespace octetra::verify::exact {

/// Sign of the volume of the tetrahedron abcd, as in octetra/core/orientation.hpp, but none of its
/// code.
[[nodiscard]] int orientation(const Point& a, const Point& b, const Point& c, const Point& d,
                              Arithmetic& arithmetic);

/// On how many faces of a positive cell a point lies that is not outside; -1 if it is outside. In a
/// lattice most points near a cell are in the plane of some face, which takes rational numbers to
/// tell, but clearly beyond another; so that is asked first.
[[nodiscard]] int faces_touched(const std::array<Point, 4>& corners, const Point& p,
                                Arithmetic& arithmetic);

/// Have the closed segment and the closed triangle, which is not degenerate, a point in common?
[[nodiscard]] bool meet(const std::array<Point, 2>& segment, const std::array<Point, 3>& triangle,
                        Arithmetic& arithmetic);

}  // namespace octetra::verify::exact
