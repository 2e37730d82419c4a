#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <octetra/core/point.hpp>

#include "files/input/fields.hpp"
#include "files/input/line_reader.hpp"
#include "files/input/tokens.hpp"
#include "files/shares/line_index.hpp"

namespace octetra::gmsh {

/// The numbers of a text file; positions are line numbers. BinaryInput has the same interface: the
/// section readers are templates for both.
///
/// If one process reads the file, from its beginning to its end, it may have free format. If
/// several do, each seeks its rows, and a row must have a line of its own; numbers outside of rows
/// may be anywhere.
class TextInput {
public:
    static constexpr std::uint64_t row_step(std::uint64_t /*bytes*/) { return 1; }

    /// The reader must be on the line before the first number. `index`: if several processes read
    /// the file; otherwise null, and calls of seek() have no effect.
    explicit TextInput(LineReader& reader, const LineIndex* index = nullptr)
        : reader_(&reader), tokens_(reader), index_(index) {}

    /// Returns the position of the next row; the current line must have been read to its end.
    [[nodiscard]] std::uint64_t here() const {
        if (index_ == nullptr) return 0;
        if (!tokens_.at_line_end()) refuse_form();
        return reader_->line_number() + 1;
    }
    /// Moves to a line. Lines within a short distance are skipped by reading.
    void seek(std::uint64_t line) {
        if (index_ == nullptr) return;
        constexpr std::uint64_t near = std::uint64_t{1} << 17U;
        if (line <= reader_->line_number() ||
            index_->position_before(line) > reader_->next_position() + near) {
            reader_->seek(index_->position_of(line), index_->file_size(), line - 1);
        }
        while (reader_->line_number() + 1 < line && reader_->next()) {
        }
        if (reader_->line_number() + 1 != line) refuse_form();
        tokens_.skip_line();
        next_row_ = line;
    }
    /// To be called after the last of consecutive rows: checks that each row had one line.
    void end_rows() const {
        if (index_ != nullptr && here() != next_row_) refuse_form();
    }

    /// Returns the name of the next section, without '$', or an empty string at the end of the
    /// file.
    [[nodiscard]] std::string section() {
        const std::string_view token = tokens_.text();
        if (token.empty()) return {};
        if (token.size() < 2 || token.front() != '$') {
            reader_->fail(fmt::format("a section, $..., expected, {} found", shown(token)));
        }
        return std::string(token.substr(1));
    }
    void end_section(std::string_view name) {
        const std::string_view token = tokens_.text();
        if (token == fmt::format("$End{}", name)) return;
        if (token.empty()) reader_->fail(fmt::format("the file ends where $End{} should be", name));
        reader_->fail(
            fmt::format("{} expected, {} found", shown(fmt::format("$End{}", name)), shown(token)));
    }
    void skip_section(std::string_view name) {
        const std::string end = fmt::format("$End{}", name);
        while (reader_->next()) {
            if (reader_->line() != end) continue;
            tokens_.skip_line();
            return;
        }
        reader_->fail(fmt::format("the file ends within the section {}", shown(name)));
    }

    /// Returns the position of the row that begins with the next number.
    [[nodiscard]] std::uint64_t begin_row(std::string_view what) {
        tokens_.require(what);
        const std::uint64_t line = reader_->line_number();
        if (index_ != nullptr && line != next_row_++) refuse_form();
        return line;
    }
    [[nodiscard]] std::uint64_t number64(std::string_view what) {
        return tokens_.unsigned_integer(what);
    }
    /// Reads a number that is a signed 32-bit integer in binary files, but never negative.
    [[nodiscard]] std::uint64_t number32(std::string_view what) {
        return tokens_.unsigned_integer(what);
    }
    /// Reads a count that version 2 writes as text also in binary files.
    [[nodiscard]] std::uint64_t count_line(std::string_view what) {
        return tokens_.unsigned_integer(what);
    }
    /// Returns the whole next line; '#' starts no comment in it.
    [[nodiscard]] std::string_view line(std::string_view what) {
        if (!reader_->next()) {
            reader_->fail(fmt::format("the file ends where {} should be", what));
        }
        tokens_.skip_line();
        return reader_->full_line();
    }
    [[nodiscard]] std::int32_t integer(std::string_view what) { return tokens_.marker(what); }
    [[nodiscard]] Point point() {
        const double x = tokens_.coordinate("x");
        const double y = tokens_.coordinate("y");
        return {x, y, tokens_.coordinate("z")};
    }
    /// Reads a value, which must be finite, and less than coordinate_limit, as means must be.
    [[nodiscard]] double real(std::string_view what) {
        tokens_.require(what);
        const double value = tokens_.real(what);
        if (std::abs(value) < coordinate_limit) return value;
        reader_->fail(fmt::format("{} is not finite and below 2^1023: {}", what, value));
    }
    /// Skips a number.
    void skip_real(std::string_view what) {
        tokens_.require(what);
        (void)tokens_.text();
    }
    /// Reads a row: the number of an element, which is ignored, and its nodes.
    template <std::size_t N>
    void row(std::array<std::uint64_t, N>& nodes, std::string_view what) {
        (void)tokens_.unsigned_integer(what);
        for (std::uint64_t& node : nodes) node = tokens_.unsigned_integer(what);
    }

    /// Throws if the rest of the file is too short for `count` entries of at least this many
    /// numbers, or bytes in a binary file.
    void check_count(std::uint64_t count, std::size_t numbers, std::size_t /*bytes*/,
                     std::string_view what) const {
        reader_->check_count(count, numbers, what);
    }
    [[noreturn]] void fail(std::string_view what) const { reader_->fail(what); }
    [[noreturn]] void fail_at(std::string_view what, std::uint64_t place) const {
        reader_->fail(what, place);
    }
    /// Returns "FILE:LINE" of the last token read.
    [[nodiscard]] std::string place() const {
        return fmt::format("{}:{}", reader_->path().native(), reader_->line_number());
    }
    /// Returns the position of the end of the file, once it has been read.
    [[nodiscard]] std::uint64_t end_position() const { return reader_->line_number(); }
    /// Whether messages can refer to positions as lines.
    static constexpr bool has_lines = true;

private:
    [[noreturn]] void refuse_form() const { reader_->fail("not a row on each line"); }

    LineReader* reader_;
    Tokens tokens_;
    const LineIndex* index_;
    std::uint64_t next_row_ = 0;  // line of the next row, if there is an index
};

}  // namespace octetra::gmsh
