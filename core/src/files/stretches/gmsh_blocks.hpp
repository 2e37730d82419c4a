#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "files/stretches/progress.hpp"
#include "files/stretches/shares.hpp"

/// Sections that are made of blocks, each behind a head that says how many rows it has: so a block
/// is found from the one before. The first process reads the heads and finds where the rows of each
/// process begin. None keeps heads: there may be as many as rows.
namespace octetra::gmsh {

/// A place between two blocks.
struct BlockStart {
    std::uint64_t place = 0;        ///< a line or byte: of the head that follows
    std::uint64_t first_row = 0;    ///< number of the row that follows
    std::uint64_t blocks_left = 0;  ///< to come, at most; 0: no more come
};

/// A block whose head was read.
template <class Block>
struct ReadBlock {
    Block block;
    std::uint64_t rows = 0;  ///< where they stand
    BlockStart next;
};

/// Where a process begins, and where the section ends.
struct BlockShare {
    BlockStart own;
    BlockStart end;
};

/// Collective. Of a section of so many rows. `read_head(at)` gives a ReadBlock; the first process
/// reads each head once, and all others receive where they begin. `begin` is the same on all
/// processes. Nothing, on all processes, if something has failed.
[[nodiscard]] inline std::optional<BlockShare> share_blocks(Progress& progress,
                                                            std::uint64_t row_count,
                                                            BlockStart begin, auto&& read_head) {
    const int size = progress.group().size();
    std::vector<BlockStart> starts;  // of each process, and where the section ends
    progress.attempt([&] {
        starts.resize(static_cast<std::size_t>(size) + 1);
        if (!progress.group().is_first()) return;
        std::optional<BlockStart> next;
        for (int rank = 0; rank <= size; ++rank) {
            const std::uint64_t row = share_of_rows(row_count, rank, size).first;
            while (begin.blocks_left > 0) {
                if (!next) next = read_head(begin).next;
                if (next->first_row > row) break;
                begin = *next;
                next.reset();
            }
            starts[static_cast<std::size_t>(rank)] = begin;
        }
    });
    if (!take_from_first(progress, std::span(starts))) return std::nullopt;
    const auto own = static_cast<std::size_t>(progress.group().rank());
    return BlockShare{starts[own], starts.back()};
}

/// Reads a process's rows: `read_rows(block, first, count)` is called for those of each block, the
/// first being counted within the block.
void read_blocks(const RowShare& mine, BlockStart at, auto&& read_head, auto&& read_rows) {
    const std::uint64_t end = mine.first + mine.count;
    for (std::uint64_t row = mine.first; row < end;) {
        if (at.blocks_left == 0) throw std::runtime_error("rows are missing");
        const auto block = read_head(at);
        const std::uint64_t count = std::min(block.next.first_row, end) - row;
        if (count > 0) read_rows(block, row - at.first_row, count);
        row += count;
        at = block.next;
    }
}

}  // namespace octetra::gmsh
