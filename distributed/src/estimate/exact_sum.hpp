#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>

namespace octetra::distributed {

/// A sum of finite, nonnegative doubles without rounding: an integer in units of the smallest
/// positive double, 2^-1074. So it does not depend on the order of the terms.
class ExactSum {
public:
    /// Number of 32-bit limbs: 2098 bits for the greatest double, and 78 for the number of terms.
    static constexpr std::size_t limb_count = 68;

    ExactSum() = default;
    /// Adds up at most 2^32 exact sums, given the sums of their limbs at each position.
    explicit ExactSum(std::span<const std::uint64_t, limb_count> sums_of_limbs) noexcept;

    void add(double addend) noexcept;

    /// Returns the smallest sum that is at least share * this sum; 0 < share <= 1.
    [[nodiscard]] ExactSum share(double share) const noexcept;

    /// Limbs below 2^32, the least significant first.
    [[nodiscard]] const std::array<std::uint64_t, limb_count>& limbs() const { return limbs_; }

    friend bool operator==(const ExactSum&, const ExactSum&) = default;
    friend std::strong_ordering operator<=>(const ExactSum& a, const ExactSum& b) noexcept;

private:
    std::array<std::uint64_t, limb_count> limbs_{};
};

}  // namespace octetra::distributed
