#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <octetra/core/point.hpp>

#include "files/input/byte_reader.hpp"
#include "files/input/fields.hpp"

namespace octetra::gmsh {

/// The numbers of a binary file, in which sections begin and end with a line of text; positions are
/// byte offsets. Has the same interface as TextInput.
class BinaryInput {
public:
    static constexpr std::uint64_t row_step(std::uint64_t bytes) { return bytes; }

    explicit BinaryInput(ByteReader& reader) : reader_(&reader) {}

    [[nodiscard]] std::string section() {
        std::string line = next_line();
        if (line.empty()) return {};
        if (line.size() < 2 || line.front() != '$') {
            fail_at(fmt::format("a section, $..., expected, {} found", shown(line)), line_begin_);
        }
        return line.substr(1);
    }
    void end_section(std::string_view name) {
        const std::string line = next_line();
        if (line == fmt::format("$End{}", name)) return;
        if (line.empty()) fail(fmt::format("the file ends where $End{} should be", name));
        fail_at(
            fmt::format("{} expected, {} found", shown(fmt::format("$End{}", name)), shown(line)),
            line_begin_);
    }
    void skip_section(std::string_view name);

    [[nodiscard]] std::uint64_t begin_row(std::string_view /*what*/) const {
        return reader_->position();
    }
    [[nodiscard]] std::uint64_t number64(std::string_view what) {
        return reader_->take<std::uint64_t>(what);
    }
    [[nodiscard]] std::uint64_t number32(std::string_view what) {
        const std::int32_t number = integer(what);
        if (number >= 0) return static_cast<std::uint64_t>(number);
        fail_at(fmt::format("{} should be a whole number from 0, not {}", what, number),
                reader_->position() - sizeof number);
    }
    [[nodiscard]] std::uint64_t count_line(std::string_view what);
    [[nodiscard]] std::string line(std::string_view what) { return reader_->take_line(what); }
    [[nodiscard]] std::int32_t integer(std::string_view what) {
        return reader_->take<std::int32_t>(what);
    }
    [[nodiscard]] Point point() {
        const double x = coordinate("x");
        const double y = coordinate("y");
        return {x, y, coordinate("z")};
    }
    [[nodiscard]] double real(std::string_view what) {
        const std::uint64_t begin = reader_->position();
        const auto value = reader_->take<double>(what);
        if (std::abs(value) < coordinate_limit) return value;
        fail_at(fmt::format("{} is not finite and below 2^1023: {}", what, value), begin);
    }
    void skip_real(std::string_view what) { reader_->skip(sizeof(double), what); }
    /// Reads a row: the number of an element, which is ignored, and its nodes.
    template <std::size_t N>
    void row(std::array<std::uint64_t, N>& nodes, std::string_view what) {
        constexpr std::size_t size = sizeof(std::uint64_t);
        const std::byte* const bytes = reader_->take_bytes((1 + N) * size, what);
        for (std::size_t k = 0; k < N; ++k) {
            nodes[k] = number_at<std::uint64_t>(bytes + (1 + k) * size, reader_->swaps_bytes());
        }
    }

    /// Returns the next bytes without consuming them, or null if fewer remain or `size` exceeds the
    /// length of any row; pass() consumes them.
    [[nodiscard]] const std::byte* peek(std::size_t size) {
        constexpr std::size_t longest_row = 1U << 12U;
        if (size > longest_row || size > reader_->remaining()) return nullptr;
        return reader_->peek_bytes(size, {});
    }
    void pass(std::size_t size) { (void)reader_->take_bytes(size, {}); }
    [[nodiscard]] bool swaps_bytes() const { return reader_->swaps_bytes(); }

    void check_count(std::uint64_t count, std::size_t /*numbers*/, std::size_t bytes,
                     std::string_view what) const {
        reader_->check_count(count, bytes, what, reader_->position());
    }
    [[noreturn]] void fail(std::string_view what) const { reader_->fail(what); }
    [[noreturn]] void fail_at(std::string_view what, std::uint64_t place) const {
        reader_->fail(what, place);
    }
    [[nodiscard]] std::string place() const { return reader_->path().native(); }
    [[nodiscard]] std::uint64_t end_position() const { return reader_->position(); }
    static constexpr bool has_lines = false;

    /// For random access to rows: the position of the next byte, and a seek.
    [[nodiscard]] std::uint64_t here() const { return reader_->position(); }
    void seek(std::uint64_t byte) { reader_->seek(byte); }
    void end_rows() const {}

private:
    /// Returns the next nonempty line, or an empty string at the end of the file.
    std::string next_line();
    [[nodiscard]] double coordinate(std::string_view what) {
        const std::byte* const bytes = reader_->peek_bytes(sizeof(double), what);
        const auto value = number_at<double>(bytes, reader_->swaps_bytes());
        if (!(std::abs(value) < coordinate_limit)) refuse_coordinate(what);  // also if it is NaN
        pass(sizeof value);
        return value;
    }
    [[noreturn]] void refuse_coordinate(std::string_view what);

    ByteReader* reader_;
    std::uint64_t line_begin_ = 0;
};

}  // namespace octetra::gmsh
