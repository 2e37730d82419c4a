#pragma once

#include <array>
#include <cstdio>
#include <new>

namespace octetra::distributed {

/// One process has no memory for what all do together: thrown on all of them. Takes none itself.
class OutOfMemory : public std::bad_alloc {
public:
    explicit OutOfMemory(int rank) noexcept : rank_(rank) {
        std::snprintf(what_.data(), what_.size(), "rank %d: out of memory", rank);
    }
    /// The one that has no memory.
    [[nodiscard]] int rank() const noexcept { return rank_; }
    [[nodiscard]] const char* what() const noexcept override { return what_.data(); }

private:
    int rank_;
    std::array<char, 48> what_{};
};

}  // namespace octetra::distributed
