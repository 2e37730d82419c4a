#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "files/gmsh/text_input.hpp"
#include "files/shares/line_index.hpp"

namespace octetra::gmsh {

/// A text file in which each row has a line of its own, with random access to rows. Throws if the
/// file has another form; numbers outside of rows may be anywhere.
class LineInput : public TextInput {
public:
    /// `head`: the reader, positioned at the first section.
    LineInput(LineReader& head, const LineIndex& index) : TextInput(head), index_(&index) {}

    /// Returns the number of the next line; the current one must have been read to its end.
    [[nodiscard]] std::uint64_t here() const {
        if (!at_line_end()) refuse();
        return current_line() + 1;
    }
    /// Moves to a line. Lines within a short distance are skipped by reading.
    void seek(std::uint64_t line_to_come) {
        constexpr std::uint64_t near = std::uint64_t{1} << 17U;
        if (line_to_come <= current_line() ||
            index_->position_before(line_to_come) > reader().next_position() + near) {
            open_at(line_to_come);
        }
        while (current_line() + 1 < line_to_come && reader().next()) {
        }
        if (current_line() + 1 != line_to_come) refuse();
        skip_line();
        expected_ = line_to_come;
    }
    [[nodiscard]] std::uint64_t begin_row(std::string_view what) {
        (void)TextInput::begin_row(what);
        if (current_line() != expected_) refuse();
        return expected_++;
    }
    /// To be called after the last row: checks that each row had one line.
    void end_rows() const {
        if (!at_line_end() || current_line() + 1 != expected_) refuse();
    }
    [[nodiscard]] std::string place() const {
        return fmt::format("{}:{}", reader().path().native(), current_line());
    }

private:
    [[noreturn]] static void refuse() { throw std::runtime_error("not a row on each line"); }
    [[nodiscard]] std::uint64_t current_line() const {
        return lines_before_ + reader().line_number();
    }
    void open_at(std::uint64_t line_to_come) {
        lines_.emplace(index_->path(), index_->position_of(line_to_come), index_->file_size());
        static_cast<TextInput&>(*this) = TextInput(*lines_);
        lines_before_ = line_to_come - 1;
    }

    const LineIndex* index_;
    std::optional<LineReader> lines_;  // reader after a jump
    std::uint64_t lines_before_ = 0;   // lines before the reader's first one
    std::uint64_t expected_ = 0;
};

}  // namespace octetra::gmsh
