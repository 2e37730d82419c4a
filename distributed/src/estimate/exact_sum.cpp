#include "estimate/exact_sum.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace octetra::distributed {
namespace {

constexpr unsigned limb_bits = 32;
constexpr std::uint64_t limb_mask = (std::uint64_t{1} << limb_bits) - 1;
constexpr unsigned unit_exponent = 1074;  ///< the unit of a sum is 2^-1074

/// A nonnegative double: mantissa * 2^shift units.
struct Parts {
    std::uint64_t mantissa;  ///< below 2^53
    unsigned shift;
};

Parts parts_of(double number) {
    constexpr std::uint64_t hidden_bit = std::uint64_t{1} << 52U;
    const auto bits = std::bit_cast<std::uint64_t>(number);
    const auto exponent = static_cast<unsigned>(bits >> 52U);
    const std::uint64_t fraction = bits & (hidden_bit - 1);
    if (exponent == 0) return {fraction, 0};
    return {fraction | hidden_bit, exponent - 1};
}

}  // namespace

ExactSum::ExactSum(std::span<const std::uint64_t, limb_count> sums_of_limbs) noexcept {
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < limb_count; ++i) {
        carry += sums_of_limbs[i];
        limbs_[i] = carry & limb_mask;
        carry >>= limb_bits;
    }
}

void ExactSum::add(double addend) noexcept {
    const auto [mantissa, shift] = parts_of(addend);
    std::size_t i = shift / limb_bits;
    const std::uint64_t low = (mantissa & limb_mask) << (shift % limb_bits);
    const std::uint64_t high = (mantissa >> limb_bits) << (shift % limb_bits);  // for the next limb
    std::uint64_t carry = low + limbs_[i];
    limbs_[i] = carry & limb_mask;
    carry = (carry >> limb_bits) + high;
    for (++i; carry != 0; ++i) {
        carry += limbs_[i];
        limbs_[i] = carry & limb_mask;
        carry >>= limb_bits;
    }
}

ExactSum ExactSum::share(double share) const noexcept {
    const auto [mantissa, shift] = parts_of(share);
    std::array<std::uint64_t, limb_count + 2> product{};  // of this sum and the mantissa
    for (const std::size_t j : {std::size_t{0}, std::size_t{1}}) {
        const std::uint64_t factor = j == 0 ? mantissa & limb_mask : mantissa >> limb_bits;
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i < limb_count; ++i) {
            carry += limbs_[i] * factor + product[i + j];
            product[i + j] = carry & limb_mask;
            carry >>= limb_bits;
        }
        product[limb_count + j] = carry;
    }
    const unsigned divided_by = unit_exponent - shift;  // exponent of a power of two
    const std::size_t limbs_off = divided_by / limb_bits;
    const unsigned bits_off = divided_by % limb_bits;
    const auto limb_of_product = [&](std::size_t i) { return i < product.size() ? product[i] : 0; };
    ExactSum result;  // large enough for all nonzero limbs, as share <= 1
    for (std::size_t i = 0; i < limb_count; ++i) {
        result.limbs_[i] = (limb_of_product(i + limbs_off) >> bits_off |
                            limb_of_product(i + limbs_off + 1) << (limb_bits - bits_off)) &
                           limb_mask;
    }
    const std::uint64_t cut_off = product[limbs_off] & ((std::uint64_t{1} << bits_off) - 1);
    const bool is_whole = cut_off == 0 && std::all_of(product.begin(), product.begin() + limbs_off,
                                                      [](std::uint64_t limb) { return limb == 0; });
    if (!is_whole) result.add(std::numeric_limits<double>::denorm_min());  // round up by one unit
    return result;
}

std::strong_ordering operator<=>(const ExactSum& a, const ExactSum& b) noexcept {
    return std::lexicographical_compare_three_way(a.limbs_.rbegin(), a.limbs_.rend(),
                                                  b.limbs_.rbegin(), b.limbs_.rend());
}

}  // namespace octetra::distributed
