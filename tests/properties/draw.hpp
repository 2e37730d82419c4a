#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <utility>

namespace octetra::properties {

/// Random draws, the same on every platform.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : engine_(seed) {}

    [[nodiscard]] std::uint64_t any() { return engine_(); }
    /// A number from 0 to n-1.
    [[nodiscard]] std::size_t below(std::size_t n) { return engine_() % n; }
    /// A number from low to high, both included.
    [[nodiscard]] int between(int low, int high) {
        return low + static_cast<int>(below(static_cast<std::size_t>(high - low) + 1));
    }
    /// A number in [0, 1).
    [[nodiscard]] double unit() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
    [[nodiscard]] bool chance(double probability) { return unit() < probability; }

    template <class T>
    void shuffle(T& items) {
        for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(i)]);
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace octetra::properties
