#pragma once

#include <array>
#include <optional>

#include <octetra/core/point.hpp>
#include <octetra/verify/verdict.hpp>

/// Decisions by exact arithmetic: in intervals first, in rational numbers where those do not
/// decide. Each is counted as the one or the other. (CGAL stands behind them, and nowhere else.)
namespace octetra::verify::exact {

/// Sign of the volume of the tetrahedron abcd, as in octetra/core/orientation.hpp, but none of its
/// code.
[[nodiscard]] int orientation(const Point& a, const Point& b, const Point& c, const Point& d,
                              Arithmetic& arithmetic);

/// The same where intervals decide; nothing, and nothing counted, where they do not.
[[nodiscard]] std::optional<int> clear_orientation(const Point& a, const Point& b, const Point& c,
                                                   const Point& d, Arithmetic& arithmetic);

/// Have the closed segment and the closed triangle, which is not degenerate, a point in common?
[[nodiscard]] bool meet(const std::array<Point, 2>& segment, const std::array<Point, 3>& triangle,
                        Arithmetic& arithmetic);

}  // namespace octetra::verify::exact
