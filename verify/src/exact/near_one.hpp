#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include <octetra/core/point.hpp>

/// Scaling by powers of two, which changes neither the sign of a volume nor an angle. Predicates
/// are evaluated on numbers near 1, for which products neither under- nor overflow: otherwise
/// intervals would not decide, and rational numbers would need a thousand bits for each factor.
namespace octetra::verify::exact {

/// The bits of |x|, which are ordered as the numbers.
[[nodiscard]] constexpr std::uint64_t magnitude(double x) {
    return std::bit_cast<std::uint64_t>(x) & 0x7fff'ffff'ffff'ffffU;
}

/// Returns x * 2^k, for -1000 <= k <= 1000. Subnormal numbers are converted as integers, since the
/// processor takes a hundred times as long to multiply them.
[[nodiscard]] inline double times_power_of_two(double x, int k) {
    constexpr int bias = 1023;
    constexpr int mantissa_bits = 52;
    constexpr int least_exponent = -1074;
    const auto power = [](int n) {
        return std::bit_cast<double>(static_cast<std::uint64_t>(n + bias) << mantissa_bits);
    };
    const std::uint64_t bits = magnitude(x);
    if (bits >> mantissa_bits != 0 || k < mantissa_bits) return x * power(k);
    const double size =
        static_cast<double>(static_cast<std::int64_t>(bits)) * power(k + least_exponent);
    return std::bit_cast<std::uint64_t>(x) >> 63U == 0 ? size : -size;
}

/// Returns whether the size is 0, or between 2^-reach and 2^reach.
template <int reach>
[[nodiscard]] constexpr bool is_near_one(double size) {
    constexpr double power = std::bit_cast<double>(static_cast<std::uint64_t>(1023 + reach) << 52U);
    return (size < power && size >= 1 / power) || size == 0;
}

/// Returns the exponent of the power of two that scales a number to a value near 1.
[[nodiscard]] inline int exponent_to_one(double size) {
    const auto exponent = static_cast<int>(magnitude(size) >> 52U) - 1023;
    return std::clamp(-exponent, -1000, 1000);
}

/// Returns whether times_power_of_two(x, k) is exact. (Enlarging a number up to 1 always is.)
[[nodiscard]] inline bool scales_exactly(double x, int k) {
    return k >= 0 || times_power_of_two(times_power_of_two(x, k), -k) == x;
}

constexpr int reach_of_volumes = 200;  ///< for products of three
constexpr int reach_of_angles = 30;    ///< for products of twelve

/// Returns whether near_one_by_axis() leaves the points unchanged.
template <class... Points>
[[nodiscard]] bool are_near_one_by_axis(const Points&... points) {
    double x = 0;
    double y = 0;
    double z = 0;
    ((x = std::max(x, std::abs(points.x))), ...);
    ((y = std::max(y, std::abs(points.y))), ...);
    ((z = std::max(z, std::abs(points.z))), ...);
    return is_near_one<reach_of_volumes>(x) && is_near_one<reach_of_volumes>(y) &&
           is_near_one<reach_of_volumes>(z);
}

/// Returns the points with each coordinate scaled by its own power of two, so that the largest is
/// near 1; an axis along which this would not be exact is left unchanged. For quantities invariant
/// under affine maps.
template <std::size_t N>
[[nodiscard]] std::array<Point, N> near_one_by_axis(const std::array<Point, N>& points) {
    std::array<Point, N> scaled = points;
    for (double Point::*axis : {&Point::x, &Point::y, &Point::z}) {
        double largest = 0;
        for (const Point& p : points) largest = std::max(largest, std::abs(p.*axis));
        if (is_near_one<reach_of_volumes>(largest)) continue;
        const int k = exponent_to_one(largest);
        const auto fits = [&](const Point& p) { return scales_exactly(p.*axis, k); };
        if (!std::all_of(points.begin(), points.end(), fits)) continue;
        for (Point& p : scaled) p.*axis = times_power_of_two(p.*axis, k);
    }
    return scaled;
}

/// Returns the points scaled by one power of two, if that is exact. For angles.
template <std::size_t N>
[[nodiscard]] std::array<Point, N> near_one(const std::array<Point, N>& points) {
    double largest = 0;
    for (const Point& p : points) {
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    if (is_near_one<reach_of_angles>(largest)) return points;
    const int k = exponent_to_one(largest);
    std::array<Point, N> scaled = points;
    for (Point& p : scaled) {
        for (double Point::*axis : {&Point::x, &Point::y, &Point::z}) {
            if (!scales_exactly(p.*axis, k)) return points;
            p.*axis = times_power_of_two(p.*axis, k);
        }
    }
    return scaled;
}

}  // namespace octetra::verify::exact
