#include "estimate/ranked_indicators.hpp"

#include <algorithm>
#include <functional>

namespace octetra::distributed {

std::vector<std::uint64_t> descending_bits(std::span<const double> indicators) {
    std::vector<std::uint64_t> bits(indicators.size());
    std::ranges::transform(indicators, bits.begin(),
                           [](double indicator) { return bits_of(indicator); });
    std::ranges::sort(bits, std::greater<>());
    return bits;
}

std::size_t count_from(std::uint64_t threshold, std::span<const std::uint64_t> descending) {
    const auto end = std::ranges::upper_bound(descending, threshold, std::greater<>());
    return static_cast<std::size_t>(end - descending.begin());
}

RankedSums::RankedSums(std::span<const std::uint64_t> descending) : descending_(descending) {
    sums_.reserve(descending.size() / block + 1);
    sums_.emplace_back();
    for (std::size_t end = block; end <= descending.size(); end += block) {
        ExactSum sum = sums_.back();
        for (std::size_t i = end - block; i < end; ++i)
            sum.add(std::bit_cast<double>(descending[i]));
        sums_.push_back(sum);
    }
}

ExactSum RankedSums::of_first(std::size_t count) const noexcept {
    ExactSum sum = sums_[count / block];
    for (std::size_t i = count / block * block; i < count; ++i) {
        sum.add(std::bit_cast<double>(descending_[i]));
    }
    return sum;
}

}  // namespace octetra::distributed
