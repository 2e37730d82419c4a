#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <octetra/core/point.hpp>

#include "files/input/fields.hpp"
#include "files/input/line_reader.hpp"
#include "files/input/tokens.hpp"

namespace octetra::gmsh {

/// The numbers of a text file, in free format; positions are line numbers. BinaryInput has the same
/// interface: the section readers are templates for both.
class TextInput {
public:
    static constexpr std::uint64_t row_step(std::uint64_t /*bytes*/) { return 1; }

    /// The reader must be on the line before the first number.
    explicit TextInput(LineReader& reader) : reader_(&reader), tokens_(reader) {}

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
        return reader_->line_number();
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

protected:
    [[nodiscard]] LineReader& reader() const { return *reader_; }
    /// Returns whether the line of the last token has no further tokens.
    [[nodiscard]] bool at_line_end() const { return tokens_.at_line_end(); }
    /// Continues after the current line of the reader.
    void skip_line() { tokens_.skip_line(); }

private:
    LineReader* reader_;
    Tokens tokens_;
};

}  // namespace octetra::gmsh
