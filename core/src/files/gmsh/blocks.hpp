#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "files/shares/shares.hpp"
#include "files/shares/status.hpp"

/// Sections that consist of blocks, each with a header that has the number of its rows: the
/// position of a block follows from the one before. The first process reads the headers and
/// determines where the rows of each process begin. No process stores headers, because there may be
/// as many as rows.
namespace octetra::gmsh {

/// A position between two blocks.
struct BlockStart {
    std::uint64_t position = 0;     ///< a line or byte: of the header that follows
    std::uint64_t first_row = 0;    ///< number of the row that follows
    std::uint64_t blocks_left = 0;  ///< maximum number of blocks that follow; 0: none
};

/// A block whose header was read.
template <class Block>
struct ReadBlock {
    Block block;
    std::uint64_t rows = 0;  ///< position of its rows
    BlockStart next;
};

/// The positions of a process's first row and of the end of the section.
struct BlockShare {
    BlockStart own;
    BlockStart end;
};

/// Collective. Distributes a section of `row_count` rows. `read_head(at)` returns a ReadBlock; the
/// first process reads each header once, and sends the other processes their positions. `begin`
/// must be equal on all processes. Returns nothing on all processes if one has failed.
[[nodiscard]] inline std::optional<BlockShare> share_blocks(CollectiveStatus& status,
                                                            std::uint64_t row_count,
                                                            BlockStart begin, auto&& read_head) {
    const int size = status.group().size();
    std::vector<BlockStart> starts;  // of each process, and of the end of the section
    status.attempt([&] {
        starts.resize(static_cast<std::size_t>(size) + 1);
        if (!status.group().is_first()) return;
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
    if (!broadcast_from_first(status, std::span(starts))) return std::nullopt;
    const auto own = static_cast<std::size_t>(status.group().rank());
    return BlockShare{starts[own], starts.back()};
}

/// Reads a process's rows. Calls read_rows(block, first, count) for the rows of each block; `first`
/// is relative to the block.
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
