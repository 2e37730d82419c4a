#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include <octetra/core/point.hpp>

/// Multiplying by a power of two changes no sign of a volume and no angle. So predicates are
/// decided on numbers near 1, where products neither under- nor overflow: intervals would tell
/// nothing of them, and rational numbers would carry a thousand bits for each factor.
namespace octetra::verify::exact {

/// The bits of |x|, which have the order of the numbers.
[[nodiscard]] constexpr std::uint64_t magnitude(double x) {
    return std::bit_cast<std::uint64_t>(x) & 0x7fff'ffff'ffff'ffffU;
}

/// x * 2^k, for -1000 <= k <= 1000. The processor takes a hundred times as long to multiply a
/// subnormal number, so these are taken as the integers that they are.
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

/// Is it 0, or between 2^-reach and 2^reach?
template <int reach>
[[nodiscard]] constexpr bool is_near_one(double size) {
    constexpr double power = std::bit_cast<double>(static_cast<std::uint64_t>(1023 + reach) << 52U);
    return (size < power && size >= 1 / power) || size == 0;
}

/// By which power of two a number is to be multiplied to come near 1.
[[nodiscard]] inline int exponent_to_one(double size) {
    const auto exponent = static_cast<int>(magnitude(size) >> 52U) - 1023;
    return std::clamp(-exponent, -1000, 1000);
}

/// Is times_power_of_two(x, k) x * 2^k exactly? (Making a number larger always is, up to 1.)
[[nodiscard]] inline bool scales_exactly(double x, int k) {
    return k >= 0 || times_power_of_two(times_power_of_two(x, k), -k) == x;
}

constexpr int reach_of_volumes = 200;  ///< for products of three
constexpr int reach_of_angles = 30;    ///< for products of twelve

/// Are the points such that near_one_by_axis() leaves them as they are?
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

/// The points with each coordinate multiplied by a power of two of its own, so that the largest is
/// near 1; those of an axis along which that would not be exact as they are. For what no affine map
/// changes.
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

/// The points multiplied by one power of two, if that is exact. For angles.
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
