#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <octetra/core/cut_runs.hpp>
#include <octetra/core/index.hpp>

#include "pattern/patterns.hpp"

namespace octetra::distributed {

[[nodiscard]] constexpr EdgeMask edges_of(Cut cut) {
    return static_cast<EdgeMask>(cut & all_edges);
}
[[nodiscard]] constexpr Cut cut_into(EdgeMask edges, std::size_t child_count) {
    const auto without = static_cast<std::size_t>(std::popcount(edges)) + 1U;
    return static_cast<Cut>(edges | (child_count > without ? 1U << 6U : 0U));
}

}  // namespace octetra::distributed
