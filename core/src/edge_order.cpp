#include <octetra/core/edge_order.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace octetra {
namespace {

/// fraction * 2^exponent, with 1/2 <= fraction < 1, or 0 as the least value.
struct WideSquare {
    int exponent = std::numeric_limits<int>::min();
    double fraction = 0;

    friend auto operator<=>(const WideSquare&, const WideSquare&) = default;
};

Point difference(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

Point scaled(const Point& p, int exponent) {
    return {std::scalbn(p.x, exponent), std::scalbn(p.y, exponent), std::scalbn(p.z, exponent)};
}

/// Scales the largest difference of coordinates to 1 <= d < 2. The digits that the others may lose
/// thereby, or by the quarter, are too small to affect the sum.
WideSquare wide_squared_length(const Segment& s) {
    int exponent = 0;
    Point d = difference(s.a, s.b);
    if (!is_finite(d)) {
        d = difference(scaled(s.a, -2), scaled(s.b, -2));
        exponent = 2;
    }
    const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    if (largest == 0) return {};
    const int shift = std::ilogb(largest);
    const double square = squared_length({scaled(d, -shift), {}});
    WideSquare result;
    result.fraction = std::frexp(square, &result.exponent);
    result.exponent += 2 * (exponent + shift);
    return result;
}

}  // namespace

std::strong_ordering compare_lengths_of_any_scale(const Segment& e, const Segment& f) {
    const WideSquare square_e = wide_squared_length(e);
    const WideSquare square_f = wide_squared_length(f);
    if (square_e < square_f) return std::strong_ordering::less;
    return square_e > square_f ? std::strong_ordering::greater : std::strong_ordering::equal;
}

}  // namespace octetra
