#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

/// Keys of coordinates, and the search for a key digit by digit.
namespace octetra::distributed {

using Key = std::uint64_t;

/// Returns an integer key with the same order as the coordinates.
inline Key key_of(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x);
    return bits >> 63U != 0 ? ~bits : bits | std::uint64_t{1} << 63U;
}
inline double coordinate_of(Key key) {
    return std::bit_cast<double>(key >> 63U != 0 ? key & ~(std::uint64_t{1} << 63U) : ~key);
}

/// The search for a key in one box, in the range `low` to `low + most`. `found` is the known
/// leading part of its difference to `low`, without the lowest `bits` bits.
struct Search {
    Key low = 0;
    Key most = 0;
    Key found = 0;
    unsigned bits = 0;

    [[nodiscard]] bool may_be(Key key) const {
        const Key difference = key - low;
        return difference <= most && above(difference) == above(found);
    }
    /// Returns the next digit of a key for which may_be() is true.
    [[nodiscard]] std::size_t digit_of(Key key, unsigned digit_bits) const {
        return (key - low - found) >> rest(digit_bits);
    }
    void take(std::size_t digit, unsigned digit_bits) {
        bits = rest(digit_bits);
        found |= Key{digit} << bits;
    }
    [[nodiscard]] Key limit() const { return low + found; }

private:
    [[nodiscard]] Key above(Key difference) const { return bits < 64 ? difference >> bits : 0; }
    [[nodiscard]] unsigned rest(unsigned digit_bits) const {
        return bits > digit_bits ? bits - digit_bits : 0;
    }
};

/// Returns a search for a key in the range `low` to `high`.
inline Search between(Key low, Key high, bool is_empty) {
    if (is_empty) return {};
    return {
        .low = low, .most = high - low, .bits = static_cast<unsigned>(std::bit_width(high - low))};
}

}  // namespace octetra::distributed
