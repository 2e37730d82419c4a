#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/index.hpp>

#include "pattern/patterns.hpp"

namespace octetra::distributed {

/// What a step did to a cell, in seven bits: bits 0 to 5 are the edges that it bisected; bit 6 is
/// set where these made one child more than there are edges and one, as they do where the longest
/// and its opposite are both among them. 0: the cell stayed whole.
using Cut = std::uint8_t;

[[nodiscard]] constexpr EdgeMask edges_of(Cut cut) {
    return static_cast<EdgeMask>(cut & all_edges);
}
[[nodiscard]] constexpr std::size_t child_count_of(Cut cut) {
    return cut == 0 ? 1 : static_cast<std::size_t>(std::popcount(edges_of(cut))) + 1U + (cut >> 6U);
}
[[nodiscard]] constexpr Cut cut_into(EdgeMask edges, std::size_t child_count) {
    const auto without = static_cast<std::size_t>(std::popcount(edges)) + 1U;
    return static_cast<Cut>(edges | (child_count > without ? 1U << 6U : 0U));
}

struct ListedCut {
    CellIndex cell;
    Cut cut = 0;
};

/// The cuts of cells that follow each other, run-length coded. A byte below 128 is one cell's cut;
/// another is that of several, less 128, and their number less 2 follows: seven bits a byte, the
/// lowest first, with the eighth bit set in all but the last.
class CutRuns {
public:
    /// One by one, or many at once; in the order of the cells.
    void append(Cut cut, std::uint64_t count = 1);
    /// After the last.
    void finish() { write_run(); }

    [[nodiscard]] std::span<const std::uint8_t> bytes() const { return bytes_; }

private:
    void write_run();

    std::vector<std::uint8_t> bytes_;
    Cut cut_ = 0;  ///< of a run that is not yet among the bytes
    std::uint64_t count_ = 0;
};

/// Calls visit(cut, count) for each run of finished cuts.
void for_each_run(const CutRuns& runs, auto&& visit) {
    const std::span<const std::uint8_t> bytes = runs.bytes();
    for (std::size_t i = 0; i < bytes.size();) {
        const std::uint8_t first = bytes[i++];
        const auto cut = static_cast<Cut>(first & 127U);
        std::uint64_t count = 1;
        if (first >= 128) {
            count = 2;
            for (unsigned shift = 0;; shift += 7) {
                const std::uint8_t byte = bytes[i++];
                count += std::uint64_t{byte & 127U} << shift;
                if (byte < 128) break;
            }
        }
        visit(cut, count);
    }
}

/// How a step cuts a process's cells: all of them, in canonical order; or those that are cut, by
/// their numbers in a list that is in no order, and each once.
struct CutCells {
    bool is_ordered = false;
    CutRuns runs;
    std::vector<ListedCut> listed;
};

}  // namespace octetra::distributed
