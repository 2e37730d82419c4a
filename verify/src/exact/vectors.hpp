#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>

#include <CGAL/Interval_nt.h>

#include <octetra/core/point.hpp>

/// Vectors between points, of intervals or of rational numbers.
namespace octetra::verify::exact {

using Interval = CGAL::Interval_nt<false>;

template <class T>
using Vector = std::array<T, 3>;

template <class T>
[[nodiscard]] Vector<T> between(const Point& a, const Point& b) {
    return {T(b.x) - T(a.x), T(b.y) - T(a.y), T(b.z) - T(a.z)};
}

template <class T>
[[nodiscard]] T dot(const Vector<T>& u, const Vector<T>& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

template <class T>
[[nodiscard]] Vector<T> cross(const Vector<T>& u, const Vector<T>& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// The sign of a number; nothing if it is not known.
[[nodiscard]] inline std::optional<int> sign_of(const Interval& x) {
    if (x.inf() > 0) return 1;
    if (x.sup() < 0) return -1;
    if (x.inf() == 0 && x.sup() == 0) return 0;
    return std::nullopt;
}
[[nodiscard]] inline std::optional<int> sign_of(const mpq_class& x) { return sgn(x); }

}  // namespace octetra::verify::exact
