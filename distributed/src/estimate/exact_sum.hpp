#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>

namespace octetra::distributed {

/// A sum of doubles that are finite and not negative, without rounding: a whole number, in units of
/// the smallest positive double, 2^-1074. So it does not depend on the order of what is added.
class ExactSum {
public:
    /// Of 32 bits: 2098 bits for the greatest double, and 78 for the number of addends.
    static constexpr std::size_t limb_count = 68;

    ExactSum() = default;
    /// From sums of limbs: limb by limb, of at most 2^32 exact sums.
    explicit ExactSum(std::span<const std::uint64_t, limb_count> sums_of_limbs) noexcept;

    void add(double addend) noexcept;

    /// The least sum that is not less than share * this one; 0 < share <= 1.
    [[nodiscard]] ExactSum share(double share) const noexcept;

    /// Each below 2^32, the least significant first.
    [[nodiscard]] const std::array<std::uint64_t, limb_count>& limbs() const { return limbs_; }

    friend bool operator==(const ExactSum&, const ExactSum&) = default;
    friend std::strong_ordering operator<=>(const ExactSum& a, const ExactSum& b) noexcept;

private:
    std::array<std::uint64_t, limb_count> limbs_{};
};

}  // namespace octetra::distributed
