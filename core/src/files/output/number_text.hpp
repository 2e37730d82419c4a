#pragma once

#include <bit>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace octetra {

/// The maximum size of a number as text, including temporary space.
inline constexpr std::size_t longest_number = 32;

namespace detail {

/// Returns the decimal digits of a number below 10^8, one a byte, the leading one in the lowest
/// byte. All are computed at once, by halving the words repeatedly.
inline std::uint64_t eight_digits(std::uint64_t number) {
    const std::uint64_t leading_four = number / 10'000;
    std::uint64_t word = leading_four | (number - leading_four * 10'000) << 32U;
    // Divides numbers below 10^4 by 100, and numbers below 100 by 10.
    const std::uint64_t hundreds = word * 5243 >> 19U & 0x0000'007f'0000'007f;
    word = hundreds | (word - hundreds * 100) << 16U;
    const std::uint64_t tens = word * 103 >> 10U & 0x000f'000f'000f'000f;
    return tens | (word - tens * 10) << 8U;
}

inline void put_eight(char* place, std::uint64_t digits) {
    static_assert(std::endian::native == std::endian::little);
    const std::uint64_t text = digits + 0x3030'3030'3030'3030;
    std::memcpy(place, &text, sizeof text);
}

inline char* put_digits(char* place, std::uint64_t number) {
    constexpr std::uint64_t eight = 100'000'000;
    if (number >= eight) {
        const std::uint64_t leading = number / eight;
        place = put_digits(place, leading);
        detail::put_eight(place, detail::eight_digits(number - leading * eight));
        return place + 8;
    }
    const std::uint64_t digits = detail::eight_digits(number);
    // The number of leading zeros; the last digit is never removed.
    const auto zeros = static_cast<unsigned>(__builtin_ctzll(digits | std::uint64_t{1} << 56U)) / 8;
    detail::put_eight(place, digits >> 8 * zeros);
    return place + (8 - zeros);
}

}  // namespace detail

/// Writes a number as text at `place` and returns its end: a real in the fewest digits that read
/// back to the same bits. There must be room for longest_number bytes.
inline char* put_number(char* place, double number) {
    return std::to_chars(place, place + longest_number, number).ptr;
}
inline char* put_number(char* place, std::unsigned_integral auto number) {
    return detail::put_digits(place, number);
}
inline char* put_number(char* place, std::signed_integral auto number) {
    const auto bits = static_cast<std::uint64_t>(std::int64_t{number});
    if (number >= 0) return detail::put_digits(place, bits);
    *place = '-';
    return detail::put_digits(place + 1, 0 - bits);
}

/// Returns the length of a whole number as text.
inline std::uint64_t text_length(std::unsigned_integral auto number) {
    std::uint64_t length = 1;
    for (std::uint64_t rest = number; rest >= 10; rest /= 10) ++length;
    return length;
}
inline std::uint64_t text_length(std::signed_integral auto number) {
    const auto bits = static_cast<std::uint64_t>(std::int64_t{number});
    return number >= 0 ? text_length(bits) : 1 + text_length(0 - bits);
}

}  // namespace octetra
