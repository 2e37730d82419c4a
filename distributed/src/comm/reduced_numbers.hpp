#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

/// Numbers that processes reduce together with a failure flag in one reduction. The memory is
/// allocated by the constructor, so a process that has failed can take part.
class ReducedNumbers {
public:
    explicit ReducedNumbers(std::size_t most) { numbers_.reserve(most + 1); }

    /// Returns `count` zeros for one reduction; `count` is at most `most`.
    [[nodiscard]] std::span<std::uint64_t> zeros(std::size_t count) noexcept {
        numbers_.assign(count + 1, 0);
        return std::span(numbers_).first(count);
    }

    /// Collective. Replaces each element of the last zeros() by its sum (maximum) over all
    /// processes. Returns false on all processes if one has failed.
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
