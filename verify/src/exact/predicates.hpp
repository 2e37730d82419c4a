#pragma once

#include <array>
#include <optional>

#include <octetra/core/point.hpp>
#include <octetra/verify/verdict.hpp>

/// Exact predicates: evaluated in floating point with an error bound, then with intervals, and with
/// rational numbers if these do not decide. Each decision is counted as one or the other. CGAL is
/// used only here and in angles.cpp.
namespace octetra::verify::exact {

/// Returns the sign of orientation() if floating point with an error bound decides it: never a
/// wrong one, and 0 never. Valid in any rounding mode.
[[nodiscard]] std::optional<int> clear_orientation(const Point& a, const Point& b, const Point& c,
                                                   const Point& d);

/// Sign of the volume of the tetrahedron abcd; defined as in octetra/core/orientation.hpp, but
/// implemented independently.
[[nodiscard]] int orientation(const Point& a, const Point& b, const Point& c, const Point& d,
                              Arithmetic& arithmetic);

/// Returns the number of faces of a positive cell that contain a point of the closed cell, or -1
/// for a point outside. In a lattice, most points near a cell are in the plane of some face, which
/// only rational numbers can decide, but clearly beyond another face, which is therefore tested
/// first.
[[nodiscard]] int faces_touched(const std::array<Point, 4>& corners, const Point& p,
                                Arithmetic& arithmetic);

/// Returns whether the closed segment and the closed nondegenerate triangle have a common point.
[[nodiscard]] bool meet(const std::array<Point, 2>& segment, const std::array<Point, 3>& triangle,
                        Arithmetic& arithmetic);

}  // namespace octetra::verify::exact
