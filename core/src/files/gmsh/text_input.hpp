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

/// The numbers of a text file, which stand where they will; places are lines. BinaryInput has the
/// same functions: the readers of sections are made for both.
class TextInput {
public:
    static constexpr std::uint64_t row_step(std::uint64_t /*bytes*/) { return 1; }

    /// The reader stands on the line behind which the numbers begin.
    explicit TextInput(LineReader& reader) : reader_(&reader), tokens_(reader) {}

    /// The name of the next section, without '$'; empty at the end of the file.
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

    /// Where the row is whose first number comes next.
    [[nodiscard]] std::uint64_t begin_row(std::string_view what) {
        tokens_.require(what);
        return reader_->line_number();
    }
    [[nodiscard]] std::uint64_t number64(std::string_view what) {
        return tokens_.unsigned_integer(what);
    }
    /// What is a signed number of 32 bits in binary files, but never negative.
    [[nodiscard]] std::uint64_t number32(std::string_view what) {
        return tokens_.unsigned_integer(what);
    }
    /// A count that version 2 writes as text in binary files, too.
    [[nodiscard]] std::uint64_t count_line(std::string_view what) {
        return tokens_.unsigned_integer(what);
    }
    /// The next line, and all of it: '#' begins no comment there.
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
    /// A number that nobody asks for.
    void skip_real(std::string_view what) {
        tokens_.require(what);
        (void)tokens_.text();
    }
    /// A row of an element's number, which nobody asks for, and its nodes.
    template <std::size_t N>
    void row(std::array<std::uint64_t, N>& nodes, std::string_view what) {
        (void)tokens_.unsigned_integer(what);
        for (std::uint64_t& node : nodes) node = tokens_.unsigned_integer(what);
    }

    /// Refuses a count, just read, of entries that the file cannot hold: each has at least so many
    /// numbers, or bytes in a binary file.
    void check_count(std::uint64_t count, std::size_t numbers, std::size_t /*bytes*/,
                     std::string_view what) const {
        reader_->check_count(count, numbers, what);
    }
    [[noreturn]] void fail(std::string_view what) const { reader_->fail(what); }
    [[noreturn]] void fail_at(std::string_view what, std::uint64_t place) const {
        reader_->fail(what, place);
    }
    /// "FILE:LINE", of what was read last.
    [[nodiscard]] std::string place() const {
        return fmt::format("{}:{}", reader_->path().native(), reader_->line_number());
    }
    /// The place where the file ends, once it is read.
    [[nodiscard]] std::uint64_t end_place() const { return reader_->line_number(); }
    /// Can a message call a place a line?
    static constexpr bool has_lines = true;

protected:
    [[nodiscard]] LineReader& reader() const { return *reader_; }
    /// Is nothing left on the line of what was read last?
    [[nodiscard]] bool at_line_end() const { return tokens_.at_line_end(); }
    /// Goes on behind the line on which the reader is.
    void skip_line() { tokens_.skip_line(); }

private:
    LineReader* reader_;
    Tokens tokens_;
};

}  // namespace octetra::gmsh
