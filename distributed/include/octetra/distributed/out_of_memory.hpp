#pragma once

#include <array>
#include <cstdio>
#include <new>

namespace octetra::distributed {

/// Thrown on all processes if one of them runs out of memory in a collective function. Allocates no
/// memory itself.
class OutOfMemory : public std::bad_alloc {
public:
    explicit OutOfMemory(int rank) noexcept : rank_(rank) {
        std::snprintf(what_.data(), what_.size(), "rank %d: out of memory", rank);
    }
    /// The rank that ran out of memory.
    [[nodiscard]] int rank() const noexcept { return rank_; }
    [[nodiscard]] const char* what() const noexcept override { return what_.data(); }

private:
    int rank_;
    std::array<char, 48> what_{};
};

}  // namespace octetra::distributed
