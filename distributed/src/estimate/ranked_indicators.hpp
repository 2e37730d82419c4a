#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "estimate/exact_sum.hpp"

namespace octetra::distributed {

/// Returns the bits of a double as an integer. For nonnegative doubles the integers have the order
/// of the doubles; they are greater for infinity, NaN and negative doubles than for all others.
/// Negative zero counts as zero.
[[nodiscard]] constexpr std::uint64_t bits_of(double number) {
    constexpr std::uint64_t negative_zero = std::uint64_t{1} << 63U;
    const auto bits = std::bit_cast<std::uint64_t>(number);
    return bits == negative_zero ? 0 : bits;
}

/// Returns the bits of a process's indicators in descending order.
[[nodiscard]] std::vector<std::uint64_t> descending_bits(std::span<const double> indicators);

/// Returns the number of indicators that are at least `threshold`.
[[nodiscard]] std::size_t count_from(std::uint64_t threshold,
                                     std::span<const std::uint64_t> descending);

/// Sums of the largest indicators.
class RankedSums {
public:
    /// Keeps a reference to `descending`.
    explicit RankedSums(std::span<const std::uint64_t> descending);

    /// Returns the sum of the first `count` indicators, in constant time.
    [[nodiscard]] ExactSum of_first(std::size_t count) const noexcept;

private:
    static constexpr std::size_t block = 1024;  // so that sums take half a byte per indicator

    std::span<const std::uint64_t> descending_;
    std::vector<ExactSum> sums_;  // [k]: the sum of the first k * block
};

}  // namespace octetra::distributed
