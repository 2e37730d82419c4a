#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::verify {

/// A set of vertices of a whole mesh, ascending, with lookup of their positions: a bit for each
/// number up to the largest one.
class VertexLookup {
public:
    /// `numbers` may be in any order and contain repetitions.
    explicit VertexLookup(const std::vector<std::uint32_t>& numbers) {
        if (numbers.empty()) return;
        bits_.assign(*std::max_element(numbers.begin(), numbers.end()) / 64 + 1, 0);
        for (const std::uint32_t n : numbers) bits_[n / 64] |= std::uint64_t{1} << n % 64;
        before_.reserve(bits_.size());
        std::uint32_t count = 0;
        for (const std::uint64_t word : bits_) {
            before_.push_back(count);
            count += static_cast<std::uint32_t>(std::popcount(word));
        }
        numbers_.reserve(count);
        for (std::uint32_t first = 0; std::uint64_t word : bits_) {
            for (; word != 0; word &= word - 1) {
                numbers_.push_back(first + static_cast<std::uint32_t>(std::countr_zero(word)));
            }
            first += 64;
        }
    }

    [[nodiscard]] const std::vector<std::uint32_t>& numbers() const { return numbers_; }

    /// Returns none() for a number that is not in the set.
    [[nodiscard]] VertexIndex find(std::uint32_t number) const {
        const std::size_t k = number / 64;
        if (k >= bits_.size() || (bits_[k] >> number % 64 & 1U) == 0) return VertexIndex::none();
        const std::uint64_t lower = bits_[k] & ((std::uint64_t{1} << number % 64) - 1);
        return VertexIndex{before_[k] + static_cast<std::uint32_t>(std::popcount(lower))};
    }

private:
    std::vector<std::uint32_t> numbers_;
    std::vector<std::uint64_t> bits_;
    std::vector<std::uint32_t> before_;  ///< for each word of bits, the count in earlier ones
};

}  // namespace octetra::verify
