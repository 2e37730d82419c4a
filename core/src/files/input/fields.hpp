#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include "files/input/line_reader.hpp"

namespace octetra {

/// Returns whether this separates fields, or belongs to a CRLF line end.
[[nodiscard]] constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Returns a token for an error message: quoted, truncated, control characters escaped.
[[nodiscard]] std::string shown(std::string_view token);

/// Messages on a coordinate or another real, `what`, which the file shows as `number`.
[[nodiscard]] std::string not_finite(std::string_view what, std::string_view number);
[[nodiscard]] std::string too_large(std::string_view what, std::string_view number);

/// Takes the fields of one line one after the other. `what` in these calls names the field for the
/// error message if it is missing or malformed; messages have the line reader's file and line.
class Fields {
public:
    /// `line`: the reader's line, a part of it, or empty.
    Fields(const LineReader& reader, std::string_view line)
        : reader_(&reader), next_(line.data()), end_(line.data() + line.size()) {
        skip_blanks();
    }
    explicit Fields(const LineReader& reader) : Fields(reader, reader.line()) {}

    [[nodiscard]] bool at_end() const { return next_ == end_; }
    /// Returns the number of remaining fields.
    [[nodiscard]] std::size_t count_left() const;

    /// Returns the next field verbatim, or an empty one at the end of the line.
    [[nodiscard]] std::string_view text();
    [[nodiscard]] std::uint64_t unsigned_integer(std::string_view what) {
        // Fast path: nearly all fields are a few digits.
        const Digits digits = digits_at(next_);
        if (!is_field(digits)) return any_unsigned_integer(what);
        take(digits);
        return digits.value;
    }
    [[nodiscard]] std::int32_t marker(std::string_view what) {
        const bool negative = next_ != end_ && *next_ == '-';
        const Digits digits = digits_at(negative ? next_ + 1 : next_);
        constexpr std::uint64_t largest = std::numeric_limits<std::int32_t>::max();
        if (!is_field(digits) || digits.value > largest) return any_marker(what);
        take(digits);
        const auto value = static_cast<std::int32_t>(digits.value);
        return negative ? -value : value;
    }
    /// Returns a finite number.
    [[nodiscard]] double real(std::string_view what);
    /// Returns a number within the limit of coordinates.
    [[nodiscard]] double coordinate(std::string_view what);

    /// Throws InputError if there are more than `expected` fields on the line.
    void expect_end(std::size_t expected) const;

private:
    void skip_blanks() {
        while (next_ != end_ && (*next_ == ' ' || *next_ == '\t' || *next_ == '\r')) ++next_;
    }
    /// At most fifteen digits, so that the value always fits.
    struct Digits {
        std::uint64_t value = 0;
        const char* stop = nullptr;  ///< end of the digits; null: none, or too many
    };
    Digits digits_at(const char* first) const {
        if (first == end_) return {};
        const DigitsOfWord leading = digits_of_word(first);
        if (leading.count == 0) return {};
        if (leading.count < 8) return {leading.value, first + leading.count};
        constexpr std::array<std::uint64_t, 8> powers{1,      10,      100,       1'000,
                                                      10'000, 100'000, 1'000'000, 10'000'000};
        const DigitsOfWord rest = digits_of_word(first + 8);
        if (rest.count == 8) return {};
        return {leading.value * powers.at(rest.count) + rest.value, first + 8 + rest.count};
    }
    struct DigitsOfWord {
        std::uint64_t value;
        unsigned count;
    };
    /// Inspects eight bytes at once, which may extend beyond the line.
    static DigitsOfWord digits_of_word(const char* first) {
        static_assert(std::endian::native == std::endian::little);
        std::uint64_t word;
        std::memcpy(&word, first, sizeof word);
        word ^= 0x3030'3030'3030'3030;  // digits become 0 to 9, all other bytes more
        // A byte above 9 sets its own highest bit; a carry may also affect the next byte, but only
        // the first such byte counts.
        const std::uint64_t others =
            ((word + 0x7676'7676'7676'7676) | word) & 0x8080'8080'8080'8080;
        const auto count = static_cast<unsigned>(std::countr_zero(others)) / 8;
        if (count == 0) return {0, 0};
        // Shifts zeros in front of the digits; then joins pairs of digits, pairs of these, and both
        // halves.
        word <<= 64 - 8 * count;
        word = (word * 10 + (word >> 8U)) & 0x00ff'00ff'00ff'00ff;
        word = (word * 100 + (word >> 16U)) & 0x0000'ffff'0000'ffff;
        return {(word * 10'000 + (word >> 32U)) & 0xffff'ffff, count};
    }
    /// Returns whether the digits are the whole next field.
    [[nodiscard]] bool is_field(const Digits& digits) const {
        if (digits.stop == nullptr || digits.stop > end_) return false;
        return digits.stop == end_ || is_blank(*digits.stop);
    }
    void take(const Digits& digits) {
        next_ = digits.stop;
        skip_blanks();
    }

    template <class Number>
    Number number(std::string_view what, std::string_view kind);
    std::uint64_t any_unsigned_integer(std::string_view what);
    std::int32_t any_marker(std::string_view what);

    const LineReader* reader_;
    const char* next_;
    const char* end_;
};

}  // namespace octetra
