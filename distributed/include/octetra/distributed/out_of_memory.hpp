#pragma once

#include <array>
#include <cstdio>
#include <new>

namespace octetra::distributed {

/// One process has no memory for what all do together: thrown on all of them. Takes none itself.
class OutOfMemory : public std::bad_alloc {
public:
    explicit OutOfMemory(int rank) noexcept {
        std::snprintf(what_.data(), what_.size(), "rank %d: out of memory", rank);
    }
    [[nodiscard]] const char* what() const noexcept override { return what_.data(); }

private:
    std::array<char, 48> what_{};
};

}  // namespace octetra::distributed
