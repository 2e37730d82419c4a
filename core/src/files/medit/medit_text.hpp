#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include <octetra/core/process_group.hpp>

#include "files/input/line_reader.hpp"
#include "files/input/tokens.hpp"
#include "files/shares/keyword_scan.hpp"
#include "files/shares/shares.hpp"

namespace octetra {

/// A Medit text file, read by one process as a whole, or by several, each of which reads its share
/// of the entries of every section and everything else.
class MeditText {
public:
    /// Collective, within a transaction if the group has several processes.
    MeditText(const std::filesystem::path& path, const ProcessGroup& group)
        : reader_(path), tokens_(reader_), group_(&group) {
        if (!is_shared()) return;
        keywords_ = scan_for_keywords(group, path, reader_.file_size());
        keywords_.push_back({reader_.file_size(), 1});  // the end follows the last keyword
    }

    [[nodiscard]] LineReader& reader() { return reader_; }
    [[nodiscard]] Tokens& tokens() { return tokens_; }

    /// Collective. Reads the `count` entries after the last token: all, or this process's share.
    /// Calls make_room(n), where n is the number of entries to make room for, then read_entry() for
    /// each.
    /// Returns the number of the first entry read.
    std::uint64_t read_entries(std::uint64_t count, auto&& make_room, auto&& read_entry) {
        if (is_shared()) return read_share(count, make_room, read_entry);
        make_room(count);
        for (std::uint64_t i = 0; i < count; ++i) read_entry();
        return 0;
    }

private:
    [[nodiscard]] bool is_shared() const { return group_->size() > 1; }

    /// Collective. The section must have an entry on each line, and end before a line with a
    /// keyword, to which the reader then moves.
    std::uint64_t read_share(std::uint64_t count, auto&& make_room, auto&& read_entry) {
        constexpr std::string_view other_form = "not an entry on each line";
        const std::uint64_t begin = reader_.next_position();
        const auto next = std::ranges::lower_bound(keywords_, begin, {}, &NumberedLine::position);
        if (!tokens_.at_line_end() || next == keywords_.end()) reader_.fail(other_form);
        const FileRange lines{begin, next->position};
        const FileRange share =
            share_of_lines(reader_.path(), lines, group_->rank(), group_->size());
        make_room(room_for(count, share, lines));
        seek(share.begin, share.end, 0);
        std::uint64_t read = 0;
        for (; tokens_.advance(); ++read) {
            const std::uint64_t line = reader_.line_number();
            read_entry();
            if (!tokens_.at_line_end() || reader_.line_number() != line) reader_.fail(other_form);
        }
        const std::uint64_t first = number_share(*group_, read, count);
        seek(next->position, reader_.file_size(), next->number - 1);
        return first;
    }

    void seek(std::uint64_t begin, std::uint64_t end, std::uint64_t lines_before) {
        reader_.seek(begin, end, lines_before);
        tokens_.skip_line();
    }

    LineReader reader_;
    Tokens tokens_;
    const ProcessGroup* group_;
    std::vector<NumberedLine> keywords_;
};

}  // namespace octetra
