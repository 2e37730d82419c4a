#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <octetra/core/huge_pages.hpp>
#include <octetra/core/index.hpp>

namespace octetra::distributed {

/// A set of vertices by global numbers of 32 bits, which returns the index of each number among
/// them in constant time. Memory: 12 bytes for every 64 numbers between the least and the greatest,
/// at most three sixteenths of a byte for each vertex of the whole mesh. If at least a quarter of
/// these numbers are in the set, also 4 bytes for each number, because a table of indices is then
/// faster than counting bits.
class VertexSet {
public:
    VertexSet() = default;

    /// The vertices of cells, facets or edges.
    explicit VertexSet(const auto& entities) {
        std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
        std::uint32_t greatest = 0;
        for (const auto& vertices : entities) {
            for (const VertexIndex v : vertices) {
                least = std::min(least, v.value());
                greatest = std::max(greatest, v.value());
            }
        }
        cover(least, greatest);
        for (const auto& vertices : entities) {
            for (const VertexIndex v : vertices) bits_[word_of(v.value())] |= bit_of(v.value());
        }
        count();
    }

    /// Adds further vertices.
    void add(const std::vector<std::uint32_t>& numbers) {
        if (numbers.empty()) return;
        const auto [least, greatest] = std::ranges::minmax(numbers);
        if (size_ == 0) {
            cover(least, greatest);
        } else {
            const VertexSet before = std::exchange(*this, {});
            cover(std::min(least, before.first_), std::max(greatest, before.last()));
            std::ranges::copy(before.bits_,
                              bits_.begin() + static_cast<std::ptrdiff_t>(word_of(before.first_)));
        }
        for (const std::uint32_t number : numbers) bits_[word_of(number)] |= bit_of(number);
        count();
    }

    [[nodiscard]] std::size_t size() const { return size_; }

    [[nodiscard]] bool has(std::uint32_t number) const {
        // wraps around to beyond the end for numbers below first_
        const std::size_t word = word_of(number);
        return word < bits_.size() && (bits_[word] & bit_of(number)) != 0;
    }

    /// Returns the number of vertices in the set with lower numbers. `v` must be in the set.
    [[nodiscard]] VertexIndex local_of(VertexIndex v) const {
        if (!indices_.empty()) return indices_[v.value() - first_];
        const std::size_t word = word_of(v.value());
        const std::uint64_t lower = bits_[word] & (bit_of(v.value()) - 1);
        return VertexIndex{before_[word] + ones_of(lower)};
    }

    /// Returns the numbers in ascending order.
    [[nodiscard]] std::vector<std::uint32_t> numbers() const {
        std::vector<std::uint32_t> numbers;
        reserve_in_huge_pages(numbers, size_);
        for (std::size_t word = 0; word < bits_.size(); ++word) {
            for (std::uint64_t bits = bits_[word]; bits != 0; bits &= bits - 1) {
                numbers.push_back(first_ + static_cast<std::uint32_t>(64 * word) +
                                  static_cast<std::uint32_t>(std::countr_zero(bits)));
            }
        }
        return numbers;
    }

private:
    [[nodiscard]] std::size_t word_of(std::uint32_t number) const {
        return (std::size_t{number} - first_) / 64;
    }
    [[nodiscard]] static std::uint64_t bit_of(std::uint32_t number) {
        return std::uint64_t{1} << (number % 64U);
    }
    /// std::popcount, which is a library call in builds for the baseline instruction set.
    [[nodiscard]] static std::size_t ones_of(std::uint64_t bits) {
        bits -= bits >> 1U & 0x5555555555555555U;
        bits = (bits & 0x3333333333333333U) + (bits >> 2U & 0x3333333333333333U);
        bits = (bits + (bits >> 4U)) & 0x0f0f0f0f0f0f0f0fU;
        return bits * 0x0101010101010101U >> 56U;
    }
    [[nodiscard]] std::uint32_t last() const {
        return first_ + static_cast<std::uint32_t>(64 * bits_.size() - 1);
    }
    void cover(std::uint32_t least, std::uint32_t greatest) {
        if (least > greatest) return;
        first_ = least / 64 * 64;
        bits_.assign(word_of(greatest) + 1, 0);
    }
    void count() {
        before_.resize(bits_.size());
        size_ = 0;
        for (std::size_t word = 0; word < bits_.size(); ++word) {
            before_[word] = static_cast<std::uint32_t>(size_);
            size_ += ones_of(bits_[word]);
        }
        list_indices();
    }
    void list_indices() {
        indices_.clear();
        if (size_ < 16 * bits_.size()) return;
        reserve_in_huge_pages(indices_, 64 * bits_.size());
        indices_.resize(64 * bits_.size());
        std::uint32_t index = 0;
        for (const std::uint32_t number : numbers()) {
            indices_[number - first_] = VertexIndex{index++};
        }
    }

    std::uint32_t first_ = 0;  // a multiple of 64
    std::vector<std::uint64_t> bits_;
    std::vector<std::uint32_t> before_;  // number of vertices before each word
    std::vector<VertexIndex> indices_;   // index of each number, or empty
    std::size_t size_ = 0;
};

}  // namespace octetra::distributed
