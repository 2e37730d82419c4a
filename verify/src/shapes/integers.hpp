#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <boost/multiprecision/cpp_int.hpp>

/// The integers of the certificate, in three sizes. A computation starts with the smallest size
/// that holds the cell, and is repeated with the next one where `fits` is false.
namespace octetra::verify::shapes {

__extension__ using Int128 = __int128;
using Int512 = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<512, 512, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, void>,
    boost::multiprecision::et_off>;
using BigInt = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>,
                                             boost::multiprecision::et_off>;

/// Squared lengths below 2^length_bits can be bisected without overflow: pieces have at most four
/// times the squared lengths of their cell, and intermediate results are at most four times these.
/// Coordinates of that size squared are below 2^length_bits as well.
template <class Int>
inline constexpr int length_bits = 0;  ///< 0: unlimited
template <>
inline constexpr int length_bits<Int128> = 122;
template <>
inline constexpr int length_bits<Int512> = 506;

template <class Int>
[[nodiscard]] bool fits(const Int& length) {
    if constexpr (length_bits<Int> == 0) {
        return true;
    } else {
        return length < (Int(1) << length_bits<Int>);
    }
}

/// A positive or negative number in floating point: fraction * 2^exponent.
struct Rounded {
    double fraction = 0;
    int exponent = 0;
};

/// Rounds, with a relative error of at most 2^-52, on every machine to the same number.
template <class Int>
[[nodiscard]] Rounded rounded(const Int& number) {
    if constexpr (std::is_same_v<Int, Int128>) {
        return {static_cast<double>(number), 0};
    } else {
        if (number == 0) return {};
        const Int size = number < 0 ? Int(-number) : number;
        const int surplus = static_cast<int>(msb(size)) - 63;
        const auto leading = static_cast<std::uint64_t>(surplus > 0 ? Int(size >> surplus) : size);
        const auto fraction = static_cast<double>(leading);
        return {number < 0 ? -fraction : fraction, surplus > 0 ? surplus : 0};
    }
}

/// Returns number * 2^shift, rounded as above unless the result is below the range of a double.
template <class Int>
[[nodiscard]] double rounded(const Int& number, int shift) {
    const Rounded result = rounded(number);
    return std::ldexp(result.fraction, result.exponent + shift);
}

/// Returns the number of bits of |number|.
template <class Int>
[[nodiscard]] int bit_count(Int number) {
    if (number < 0) number = -number;
    if constexpr (std::is_same_v<Int, Int128>) {
        int bits = 0;
        for (; number != 0; number >>= 1) ++bits;
        return bits;
    } else {
        return number == 0 ? 0 : static_cast<int>(msb(number)) + 1;
    }
}

template <class Int>
[[nodiscard]] Int common_divisor(Int a, Int b) {
    if (a < 0) a = -a;
    if (b < 0) b = -b;
    while (b != 0) {
        const Int rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

}  // namespace octetra::verify::shapes
