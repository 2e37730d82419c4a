#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

/// Keys of coordinates, and how one of them is found digit by digit.
namespace octetra::distributed {

using Key = std::uint64_t;

/// A whole number that orders as the coordinate does.
inline Key key_of(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x);
    return bits >> 63U != 0 ? ~bits : bits | std::uint64_t{1} << 63U;
}
inline double coordinate_of(Key key) {
    return std::bit_cast<double>(key >> 63U != 0 ? key & ~(std::uint64_t{1} << 63U) : ~key);
}

/// Where a key is looked for in each box: from `low` to `low + most`, in numbers of so many bits;
/// what has been found of it is `found`, but for the lowest `bits`.
struct Search {
    Key low = 0;
    Key most = 0;
    Key found = 0;
    unsigned bits = 0;

    [[nodiscard]] bool may_be(Key key) const {
        const Key difference = key - low;
        return difference <= most && above(difference) == above(found);
    }
    /// Of a key that it may be: the next digit.
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

/// Of a key from one to another.
inline Search between(Key low, Key high, bool is_empty) {
    if (is_empty) return {};
    return {
        .low = low, .most = high - low, .bits = static_cast<unsigned>(std::bit_width(high - low))};
}

}  // namespace octetra::distributed
