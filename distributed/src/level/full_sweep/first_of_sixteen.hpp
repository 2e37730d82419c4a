#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <octetra/core/index.hpp>

namespace octetra::distributed {

/// Returns the position of the first of sixteen vertices that equals `wanted`, or 16. All are
/// compared at once, because the branches of a loop would be mispredicted.
inline std::uint32_t first_of_sixteen(const VertexIndex* list, VertexIndex wanted) {
    using Four = std::uint32_t __attribute__((vector_size(16)));
    using Two = std::uint64_t __attribute__((vector_size(16)));
    static_assert(sizeof(VertexIndex) == sizeof(std::uint32_t));
    Four bits{1, 2, 4, 8};
    Four found{};
    for (std::size_t k = 0; k < 16; k += 4) {
        Four four;
        std::memcpy(&four, list + k, sizeof(four));
        found |= std::bit_cast<Four>(four == wanted.value()) & bits;
        bits <<= 4U;
    }
    const auto halves = std::bit_cast<Two>(found);
    const std::uint64_t both = halves[0] | halves[1];
    return static_cast<std::uint32_t>(std::countr_zero(both | both >> 32U | 1U << 16U));
}

}  // namespace octetra::distributed
