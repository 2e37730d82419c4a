#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

/// Numbers that processes reduce, and with them whether one has failed: one call of all tells both.
/// The memory is there from the beginning, so that who has failed takes part.
class ReducedNumbers {
public:
    explicit ReducedNumbers(std::size_t most) { numbers_.reserve(most + 1); }

    /// So many zeros, `most` at most, for one reduction.
    [[nodiscard]] std::span<std::uint64_t> zeros(std::size_t count) noexcept {
        numbers_.assign(count + 1, 0);
        return std::span(numbers_).first(count);
    }

    /// Collective. Each of the last zeros(), as they now are, becomes the sum, or the greatest, of
    /// those at its place on all processes. False, on all alike, where one has failed.
    [[nodiscard]] bool sum(const Communicator& processes, const LocalFailure& failure) {
        numbers_.back() = failure.found() ? 1 : 0;
        processes.sum(std::span(numbers_));
        return numbers_.back() == 0;
    }
    [[nodiscard]] bool max(const Communicator& processes, const LocalFailure& failure) {
        numbers_.back() = failure.found() ? 1 : 0;
        processes.max(std::span(numbers_));
        return numbers_.back() == 0;
    }

private:
    std::vector<std::uint64_t> numbers_;
};

}  // namespace octetra::distributed
