#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include <octetra/core/point.hpp>

#include "exact/near_one.hpp"

/// Volumes in integers of fixed size, which most coordinates permit: those of a cell mostly are
/// multiples of 2^-60 of the largest one.
namespace octetra::verify::exact {

__extension__ using Int128 = __int128;
__extension__ using UInt128 = unsigned __int128;

/// Converts coordinates to multiples of a power of two.
class Grid {
public:
    static constexpr int bits = 61;

    /// A grid for coordinates up to `largest`. Converts none if these are too close to the limits
    /// of a double.
    explicit Grid(double largest = 0) {
        const int exponent = static_cast<int>(magnitude(largest) >> 52U) - 1023;
        constexpr int least = -900;
        if (exponent < least || std::isinf(largest)) return;
        shift_ = bits - 1 - exponent;
        factor_ = times_power_of_two(1, shift_);
    }

    /// The integer n stands for n * 2^-shift.
    [[nodiscard]] int shift() const { return shift_; }

    /// Sets the integers and returns true, if they are exact and less than 2^61.
    [[nodiscard]] bool convert(const Point& p, std::array<std::int64_t, 3>& integers) const {
        return convert(p.x, integers[0]) && convert(p.y, integers[1]) && convert(p.z, integers[2]);
    }

private:
    [[nodiscard]] bool convert(double x, std::int64_t& integer) const {
        const double scaled = x * factor_;
        constexpr auto limit = static_cast<double>(std::int64_t{1} << bits);
        if (!(std::abs(scaled) < limit)) return false;
        integer = static_cast<std::int64_t>(scaled);
        return static_cast<double>(integer) == scaled && (integer != 0 || x == 0);
    }

    double factor_ = 0;
    int shift_ = 0;
};

/// A sum of up to 2^60 determinants of such integers: an integer of 256 bits, in two's complement.
class DeterminantSum {
public:
    using Corner = std::array<std::int64_t, 3>;
    using Limbs = std::array<std::uint64_t, 4>;  ///< least significant first

    [[nodiscard]] const Limbs& limbs() const { return limbs_; }
    [[nodiscard]] bool is_zero() const { return limbs_ == Limbs{}; }
    void clear() { limbs_ = {}; }

    /// Adds det(b - a, c - a, d - a) times 1 or -1.
    void add(const Corner& a, const Corner& b, const Corner& c, const Corner& d, int sign) {
        const Corner u = difference(b, a);
        const Corner v = difference(c, a);
        const Corner w = difference(d, a);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3;
            const std::size_t j = (k + 2) % 3;
            add_product(Int128{u[i]} * v[j] - Int128{u[j]} * v[i], w[k] * sign);
        }
    }

private:
    static Corner difference(const Corner& p, const Corner& q) {
        return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
    }

    void add_product(Int128 a, std::int64_t b) {
        const UInt128 size_of_a = a < 0 ? -static_cast<UInt128>(a) : static_cast<UInt128>(a);
        const std::uint64_t size_of_b =
            b < 0 ? -static_cast<std::uint64_t>(b) : static_cast<std::uint64_t>(b);
        const UInt128 low = UInt128{static_cast<std::uint64_t>(size_of_a)} * size_of_b;
        const UInt128 high =
            UInt128{static_cast<std::uint64_t>(size_of_a >> 64U)} * size_of_b + (low >> 64U);
        const Limbs product{static_cast<std::uint64_t>(low), static_cast<std::uint64_t>(high),
                            static_cast<std::uint64_t>(high >> 64U), 0};
        const bool negative = (a < 0) != (b < 0);
        std::uint64_t carry = negative ? 1 : 0;  // subtracts by adding the complement
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint64_t limb = negative ? ~product[k] : product[k];
            const UInt128 sum = UInt128{limbs_[k]} + limb + carry;
            limbs_[k] = static_cast<std::uint64_t>(sum);
            carry = static_cast<std::uint64_t>(sum >> 64U);
        }
    }

    Limbs limbs_{};
};

}  // namespace octetra::verify::exact
