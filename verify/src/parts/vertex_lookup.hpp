#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::verify {

/// A set of vertices of a whole mesh, ascending, with lookup of their positions.
class VertexLookup {
public:
    /// `numbers` may be in any order and contain repetitions.
    explicit VertexLookup(std::vector<std::uint32_t> numbers) : numbers_(std::move(numbers)) {
        std::sort(numbers_.begin(), numbers_.end());
        numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
        numbers_.shrink_to_fit();
        if (numbers_.empty()) return;
        bucket_begin_.assign(bucket_of(numbers_.back()) + 2, 0);
        for (const std::uint32_t n : numbers_) ++bucket_begin_[bucket_of(n) + 1];
        for (std::size_t b = 1; b < bucket_begin_.size(); ++b) {
            bucket_begin_[b] += bucket_begin_[b - 1];
        }
    }

    [[nodiscard]] const std::vector<std::uint32_t>& numbers() const { return numbers_; }

    /// Returns none() for a number that is not in the set.
    [[nodiscard]] VertexIndex find(std::uint32_t number) const {
        const std::size_t bucket = bucket_of(number);
        if (bucket + 1 >= bucket_begin_.size()) return VertexIndex::none();
        const auto at = [&](std::size_t i) {
            return numbers_.begin() + static_cast<std::ptrdiff_t>(i);
        };
        const auto end = at(bucket_begin_[bucket + 1]);
        const auto found = std::lower_bound(at(bucket_begin_[bucket]), end, number);
        if (found == end || *found != number) return VertexIndex::none();
        return VertexIndex{static_cast<std::size_t>(found - numbers_.begin())};
    }

private:
    static constexpr unsigned bucket_bits = 6;  // a compromise of speed and memory
    static std::size_t bucket_of(std::uint32_t number) { return number >> bucket_bits; }

    std::vector<std::uint32_t> numbers_;
    std::vector<std::uint32_t> bucket_begin_;
};

}  // namespace octetra::verify
