#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "estimate/exact_sum.hpp"

namespace octetra::distributed {

/// The bits of a double as a number. Among doubles that are not negative, these numbers have the
/// order of the doubles; they are greater for infinity, for what is not a number and for negative
/// doubles than for all others. Negative zero counts as zero.
[[nodiscard]] constexpr std::uint64_t bits_of(double number) {
    constexpr std::uint64_t negative_zero = std::uint64_t{1} << 63U;
    const auto bits = std::bit_cast<std::uint64_t>(number);
    return bits == negative_zero ? 0 : bits;
}

/// The bits of a process's indicators, the greatest first.
[[nodiscard]] std::vector<std::uint64_t> descending_bits(std::span<const double> indicators);

/// How many are at least `threshold`.
[[nodiscard]] std::size_t count_from(std::uint64_t threshold,
                                     std::span<const std::uint64_t> descending);

/// Sums of the greatest indicators.
class RankedSums {
public:
    /// `descending` is looked at later, too.
    explicit RankedSums(std::span<const std::uint64_t> descending);

    /// Of the first `count`; takes the same time for any.
    [[nodiscard]] ExactSum of_first(std::size_t count) const noexcept;

private:
    static constexpr std::size_t block = 1024;  // a sum for each takes half a byte an indicator

    std::span<const std::uint64_t> descending_;
    std::vector<ExactSum> sums_;  // [k]: of the first k * block
};

}  // namespace octetra::distributed
