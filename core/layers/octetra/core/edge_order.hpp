#pragma once

#include <compare>

#include <octetra/core/point.hpp>

/// The strict total order of edges by length, which determines every bisection.
///
/// Laws, for edges of one cell that is not flat:
///  - exactly one of longer(e, f), longer(f, e) holds when e and f are different edges;
///  - longer(e, f) does not depend on the order in which end points are given, nor on any vertex
///    number: only on coordinates. Every process finds the same longest edge;
///  - nor on the scale: multiplying all coordinates by a power of two changes no result, as long as
///    the multiplication is exact.
///
/// Internal to the libraries and not installed: a fused multiply-add could round a squared length
/// differently in different places, so sources that include this header are compiled with
/// -ffp-contract=off. Users of the libraries need no such option.
namespace octetra {

/// An edge, given by its end points.
struct Segment {
    Point a;
    Point b;
};

[[nodiscard]] constexpr double squared_length(const Segment& s) {
    const double dx = s.a.x - s.b.x;
    const double dy = s.a.y - s.b.y;
    const double dz = s.a.z - s.b.z;
    return (dx * dx + dy * dy) + dz * dz;
}

/// A squared length that is finite and at least this equals the result with unlimited exponents: a
/// denormal square, which has lost digits, is less than 2^-108 of it, and adding less than 2^-54 of
/// a number to it, once or twice, does not change it.
inline constexpr double least_sure_square = 0x1p-900;

[[nodiscard]] constexpr bool is_sure_square(double square) {
    constexpr double largest = 0x1.fffffffffffffp+1023;
    return least_sure_square <= square && square <= largest;
}

/// Compares the squared lengths of two edges, each rounded as binary64 with unlimited exponents.
[[nodiscard]] std::strong_ordering compare_lengths_of_any_scale(const Segment& e, const Segment& f);

/// Returns whether e is longer than f in the strict order: by squared length, in binary64 with
/// unlimited exponents; of edges of equal length, the one whose lexicographically smaller end point
/// is larger, then the one whose larger end point is larger.
[[nodiscard]] constexpr bool longer(const Segment& e, const Segment& f) {
    const double length_e = squared_length(e);
    const double length_f = squared_length(f);
    if (is_sure_square(length_e) && is_sure_square(length_f)) {
        if (length_e != length_f) return length_e > length_f;
    } else if (const auto order = compare_lengths_of_any_scale(e, f); order != 0) {
        return order > 0;
    }

    const bool e_ascends = e.a < e.b;
    const bool f_ascends = f.a < f.b;
    const Point& e_low = e_ascends ? e.a : e.b;
    const Point& f_low = f_ascends ? f.a : f.b;
    if (e_low != f_low) return e_low > f_low;

    const Point& e_high = e_ascends ? e.b : e.a;
    const Point& f_high = f_ascends ? f.b : f.a;
    return e_high > f_high;
}

}  // namespace octetra
