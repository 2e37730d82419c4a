#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

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

struct ListedCut {
    CellIndex cell;
    Cut cut = 0;
};

/// How a step cuts a process's cells: all of them, in canonical order; or those that are cut, by
/// their numbers in a list that is in no order, and each once.
struct CutCells {
    bool is_ordered = false;
    CutRuns runs;
    std::vector<ListedCut> listed;
};

}  // namespace octetra::distributed
