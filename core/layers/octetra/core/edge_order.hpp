#pragma once

#include <compare>

#include <octetra/core/point.hpp>

/// The strict order of edges by length that all of Octetra bisects by.
///
/// Laws, for edges of one cell that is not flat:
///  - exactly one of longer(e, f), longer(f, e) holds when e and f are different edges;
///  - longer(e, f) does not depend on the order in which end points are given, nor on any vertex
///    number: only on coordinates. Every process finds the same longest edge;
///  - nor on the scale: multiplying all coordinates by a power of two changes no answer, as long as
///    it is exact.
/// For layers only, and not installed: a fused multiply-add would round a squared length otherwise
/// in one place than in another, so what includes this is compiled with -ffp-contract=off. Users of
/// the libraries need no such option.
namespace octetra {

/// An edge by the positions of its end points.
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

/// A squared length that is not less than this, and finite, is what it would be if exponents had no
/// limits: a square that is denormal, and so has lost digits, is less than 2^-108 of it, and adding
/// what is less than 2^-54 of a number to it changes nothing, neither once nor twice.
inline constexpr double least_sure_square = 0x1p-900;

[[nodiscard]] constexpr bool is_sure_square(double square) {
    constexpr double largest = 0x1.fffffffffffffp+1023;
    return least_sure_square <= square && square <= largest;
}

/// Compares the squared lengths of two edges as binary64 would round them if exponents had no
/// limits.
[[nodiscard]] std::strong_ordering compare_lengths_of_any_scale(const Segment& e, const Segment& f);

/// Is e longer than f in the strict order: by squared length, in binary64 as if exponents had no
/// limits; a tie goes to the edge whose lexicographically smaller end point is larger, then to the
/// one whose larger end point is.
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
