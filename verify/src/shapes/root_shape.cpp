#include "shapes/root_shape.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>

namespace octetra::verify::shapes {
namespace {

/// A number as an odd integer times a power of two, or zero.
struct Binary {
    std::int64_t odd = 0;
    int exponent = 0;
};

Binary binary(double x) {
    if (x == 0) return {};
    constexpr int digits = 53;
    int exponent = 0;
    const double fraction = std::frexp(x, &exponent);
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(fraction, digits));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
    return {mantissa / (std::int64_t{1} << zeros), exponent - digits + zeros};
}

/// Returns the vectors, in units of 2^unit, divided by their greatest common divisor.
template <class Int>
Vectors<Int> primitive_vectors(const std::array<Binary, 12>& coordinates, int unit) {
    const auto integer = [&](const Binary& x) {
        return Int(x.odd) * (Int(1) << (x.odd == 0 ? 0 : x.exponent - unit));
    };
    Vectors<Int> vectors;
    Int divisor = 0;
    for (std::size_t k = 0; k < 9; ++k) {
        vectors[k] = integer(coordinates[3 + k]) - integer(coordinates[k % 3]);
        if (divisor != 1) divisor = common_divisor<Int>(divisor, vectors[k]);
    }
    if (divisor > 1) {
        for (Int& x : vectors) x /= divisor;
    }
    return vectors;
}

template <class Int>
bool are_small(const Vectors<Int>& vectors) {
    constexpr int bits = 60;  // squared lengths are then less than 3 * 2^120
    return std::ranges::all_of(vectors, [](const Int& x) { return bit_count(x) <= bits; });
}

template <class Int>
RootShape small_shape(const Vectors<Int>& vectors) {
    RootShape root{.is_small = true};
    for (std::size_t k = 0; k < 9; ++k) root.small[k] = static_cast<std::int64_t>(vectors[k]);
    return root;
}

}  // namespace

RootShape root_shape(std::array<Point, 4> corners) {
    std::ranges::sort(corners);
    std::array<Binary, 12> coordinates;
    int least = std::numeric_limits<int>::max();
    int greatest = std::numeric_limits<int>::min();
    for (std::size_t k = 0; k < 12; ++k) {
        const Point& p = corners[k / 3];
        coordinates[k] = binary(k % 3 == 0 ? p.x : k % 3 == 1 ? p.y : p.z);
        if (coordinates[k].odd == 0) continue;
        least = std::min(least, coordinates[k].exponent);
        greatest = std::max(greatest, coordinates[k].exponent);
    }
    constexpr int shift_in_128_bits = 70;  // of numbers of 53 bits, of which two are subtracted
    if (greatest - least <= shift_in_128_bits) {
        const auto vectors = primitive_vectors<Int128>(coordinates, least);
        if (are_small(vectors)) return small_shape(vectors);
    }
    auto vectors = primitive_vectors<BigInt>(coordinates, least);
    if (are_small(vectors)) return small_shape(vectors);
    return {.vectors = std::move(vectors)};
}

std::string bytes_of(const RootShape& root) {
    if (root.is_small) {
        return {reinterpret_cast<const char*>(root.small.data()), sizeof root.small};
    }
    std::string bytes;
    for (const BigInt& x : root.vectors) bytes += x.str() + ' ';
    return bytes;
}

BigInt six_volumes(const RootShape& root) {
    const auto [ax, ay, az, bx, by, bz, cx, cy, cz] = vectors_of<BigInt>(root);
    const BigInt volume =
        ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
    return volume < 0 ? BigInt(-volume) : volume;
}

}  // namespace octetra::verify::shapes
