#include <octetra/core/orientation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <boost/multiprecision/cpp_int.hpp>

namespace octetra {
namespace {

using boost::multiprecision::cpp_int;

/// The 3 x 3 matrix whose rows are b - a, c - a, d - a.
template <class Number>
using Rows = std::array<std::array<Number, 3>, 3>;

/// Expands along the third column; used by the filter and the exact evaluation.
template <class Number>
Number determinant(const Rows<Number>& m) {
    return m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) +
           m[1][2] * (m[2][0] * m[0][1] - m[2][1] * m[0][0]) +
           m[2][2] * (m[0][0] * m[1][1] - m[0][1] * m[1][0]);
}

/// Returns a bound on the sum of the absolute values of the six products.
double permanent(const Rows<double>& m) {
    const auto abs2 = [](double a, double b, double c, double d) {
        return std::abs(a * b) + std::abs(c * d);
    };
    return std::abs(m[0][2]) * abs2(m[1][0], m[2][1], m[1][1], m[2][0]) +
           std::abs(m[1][2]) * abs2(m[2][0], m[0][1], m[2][1], m[0][0]) +
           std::abs(m[2][2]) * abs2(m[0][0], m[1][1], m[0][1], m[1][0]);
}

/// x = mantissa * 2^exponent, with an integer mantissa of at most 53 bits.
struct Binary {
    std::int64_t mantissa = 0;
    int exponent = 0;
};

Binary split(double x) {
    constexpr int mantissa_bits = 53;
    int exponent = 0;
    const double fraction = std::frexp(x, &exponent);
    return {static_cast<std::int64_t>(std::ldexp(fraction, mantissa_bits)),
            exponent - mantissa_bits};
}

int exact_orientation(const std::array<std::array<double, 3>, 4>& points) {
    // Scaling by a power of two makes all coordinates integers and preserves the sign.
    std::array<std::array<Binary, 3>, 4> parts;
    int lowest = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            parts[i][k] = split(points[i][k]);
            if (parts[i][k].mantissa != 0) lowest = std::min(lowest, parts[i][k].exponent);
        }
    }
    const auto integer = [&](const Binary& b) {
        cpp_int value = b.mantissa;
        if (b.mantissa != 0) value <<= static_cast<unsigned>(b.exponent - lowest);
        return value;
    };
    Rows<cpp_int> rows;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            rows[i][k] = integer(parts[i + 1][k]) - integer(parts[0][k]);
        }
    }
    return determinant(rows).sign();
}

}  // namespace

int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Rows<double> rows{{{b.x - a.x, b.y - a.y, b.z - a.z},
                             {c.x - a.x, c.y - a.y, c.z - a.z},
                             {d.x - a.x, d.y - a.y, d.z - a.z}}};
    const double value = determinant(rows);

    // Forward error: every term of the determinant passes through at most 8 roundings (3
    // differences, 2 products, 3 sums), so |error| <= 8 * 2^-53 * permanent up to higher orders;
    // twice that covers them and the rounding of the permanent. A product that underflows is off by
    // at most 2^-1075, and may then be multiplied by a third column entry. The bound for that is
    // larger than necessary, because arithmetic below 2^-1022 is slow on many processors. On
    // overflow the bound is infinite or NaN, and both comparisons are false.
    constexpr double relative_error = 0x1p-49;
    constexpr double underflow_error = 0x1p-1022;
    const double third_column = std::abs(rows[0][2]) + std::abs(rows[1][2]) + std::abs(rows[2][2]);
    const double bound = relative_error * permanent(rows) + underflow_error * (1 + third_column);
    if (value > bound) return 1;
    if (value < -bound) return -1;
    return exact_orientation(
        {{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}, {d.x, d.y, d.z}}});
}

}  // namespace octetra
