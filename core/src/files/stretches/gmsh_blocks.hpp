#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "files/stretches/progress.hpp"
#include "files/stretches/shares.hpp"

/// Sections that are made of blocks, each behind a head that says how many rows it has: so a block
/// is found from the one before. Processes share out the rows, and tell the next where its first
/// ones are. None keeps heads: there may be as many as rows.
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

/// Collective. `read_head(at)` gives a ReadBlock. `begin` is the same on all processes.
[[nodiscard]] inline BlockShare share_blocks(Progress& progress, const RowShare& mine,
                                             BlockStart begin, auto&& read_head) {
    const ProcessGroup& group = progress.group();
    BlockShare share;
    const auto find_end_of_mine = [&] {
        while (begin.blocks_left > 0) {
            const BlockStart next = read_head(begin).next;
            if (next.first_row > mine.first + mine.count) break;
            begin = next;
        }
    };
    for (int rank = 0; rank < group.size(); ++rank) {
        if (rank == group.rank()) {
            share.own = begin;
            progress.attempt(find_end_of_mine);
        }
        begin = of_rank(group, rank, begin);
    }
    share.end = begin;
    return share;
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
