#pragma once

#include <cstdint>
#include <random>

namespace octetra::generator {

/// Random numbers in [0, 1), the same on every platform (unlike std::uniform_real_distribution).
class Uniform {
public:
    explicit Uniform(std::uint64_t seed) : engine_(seed) {}

    double operator()() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }

private:
    std::mt19937_64 engine_;
};

}  // namespace octetra::generator
