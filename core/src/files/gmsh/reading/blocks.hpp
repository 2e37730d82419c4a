#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/process_group.hpp>

#include "files/shares/gather.hpp"
#include "files/shares/shares.hpp"

namespace octetra::gmsh {

/// The announced size of a section of blocks.
struct SectionTotals {
    std::optional<std::uint64_t> blocks;  ///< nothing: not announced, and no block is empty
    std::uint64_t entries = 0;
};

/// A section that consists of blocks, each with a header that has the number of its rows: the
/// position of a block follows from the one before. If several processes read the file, the first
/// one reads all headers, and determines where the rows of each process begin. No process stores
/// headers, because there may be as many as rows.
template <class Input, class ReadHead>
class BlockSection {
    using Block = std::invoke_result_t<ReadHead&, std::uint64_t>;

public:
    /// Collective. The input must be positioned at the first header. read_head(left) reads a header
    /// and returns a Block, where `left` entries of the section remain.
    BlockSection(Input& in, const ProcessGroup& group, const SectionTotals& totals,
                 ReadHead read_head)
        : in_(&in),
          totals_(totals),
          read_head_(std::move(read_head)),
          mine_(share_of_rows(totals.entries, group)),
          begin_{.position = in.here()} {
        if (group.size() > 1) find_share(group);
    }

    /// Reads this process's entries, called `what` in messages: calls read_rows(block, rows, first,
    /// count) for each block, where `rows` is the position of its rows, of which `count` are read
    /// from the one with number `first`.
    void read(std::string_view what, auto&& read_rows) {
        const std::uint64_t end = mine_.first + mine_.count;
        std::uint64_t row = mine_.first;
        Start at = begin_;
        while (has_block(at) && (row < end || !end_)) {
            const ReadBlock of = read_block(at);
            const std::uint64_t count = std::min(of.next.first_row, end) - row;
            if (count > 0) read_rows(of.block, of.rows, row - at.first_row, count);
            row += count;
            at = of.next;
        }
        if (row < end) {
            in_->fail(fmt::format("{} of the {} {} announced are missing", totals_.entries - row,
                                  totals_.entries, what));
        }
        if (end_) in_->seek(*end_);
    }

private:
    /// A position between two blocks.
    struct Start {
        std::uint64_t position = 0;   ///< of the header that follows
        std::uint64_t first_row = 0;  ///< number of the row that follows
        std::uint64_t block = 0;      ///< number of the block that follows
    };
    struct ReadBlock {
        Block block;
        std::uint64_t rows = 0;  ///< position of its rows
        Start next;
    };

    [[nodiscard]] bool has_block(const Start& at) const {
        return totals_.blocks ? at.block < *totals_.blocks : at.first_row < totals_.entries;
    }
    ReadBlock read_block(const Start& at) {
        in_->seek(at.position);
        const Block block = read_head_(totals_.entries - at.first_row);
        const std::uint64_t rows = in_->here();
        return {block,
                rows,
                {rows + block.template length<Input>(), at.first_row + block.count, at.block + 1}};
    }

    /// Collective. Finds where this process's rows begin, and the end of the section.
    void find_share(const ProcessGroup& group) {
        std::vector<Start> starts;  // of each process, and of the end
        if (group.is_first()) {
            Start at = begin_;
            std::optional<Start> next;
            for (int rank = 0; rank <= group.size(); ++rank) {
                const std::uint64_t row = share_of_rows(totals_.entries, rank, group.size()).first;
                while (has_block(at)) {
                    if (!next) next = read_block(at).next;
                    if (next->first_row > row) break;
                    at = *std::exchange(next, std::nullopt);
                }
                starts.push_back(at);
            }
        }
        starts = gather_lists(group, std::span<const Start>(starts)).front();
        begin_ = starts[static_cast<std::size_t>(group.rank())];
        end_ = starts.back().position;
    }

    Input* in_;
    SectionTotals totals_;
    ReadHead read_head_;
    RowShare mine_;
    Start begin_;
    std::optional<std::uint64_t> end_;  // position, if several processes read the file
};

}  // namespace octetra::gmsh
