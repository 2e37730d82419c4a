#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "files/input/line_reader.hpp"

namespace octetra {

/// Does this stand between fields, or at the end of a line that Windows wrote?
[[nodiscard]] constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// A token as an error message can show it: quoted, cut short, control characters escaped.
[[nodiscard]] std::string shown(std::string_view token);

/// What is wrong with a coordinate or another real, `what`, that files show as `number`.
[[nodiscard]] std::string not_finite(std::string_view what, std::string_view number);
[[nodiscard]] std::string too_large(std::string_view what, std::string_view number);

/// Takes the fields of one line one after the other. `what` in these calls names the field for the
/// error message that a missing or malformed one gets, with the line reader's file and line.
class Fields {
public:
    Fields(const LineReader& reader, std::string_view line)
        : reader_(&reader), next_(line.data()), end_(line.data() + line.size()) {
        skip_blanks();
    }
    explicit Fields(const LineReader& reader) : Fields(reader, reader.line()) {}

    [[nodiscard]] bool at_end() const { return next_ == end_; }
    /// How many fields are left.
    [[nodiscard]] std::size_t count_left() const;

    /// The next field as it stands, or an empty one at the end.
    [[nodiscard]] std::string_view text();
    [[nodiscard]] std::uint64_t unsigned_integer(std::string_view what) {
        // Nearly all are a few digits and nothing else, and most of a file; the rest goes the long
        // way.
        const char* stop = next_;
        const std::uint64_t value = digits(stop);
        if (!is_field(stop)) return any_unsigned_integer(what);
        take(stop);
        return value;
    }
    [[nodiscard]] std::int32_t marker(std::string_view what) {
        constexpr std::ptrdiff_t always_fits = 9;  // digits, into 32 bits
        const char* stop = next_ != end_ && *next_ == '-' ? next_ + 1 : next_;
        const bool negative = stop != next_;
        const char* const first = stop;
        const auto value = static_cast<std::int64_t>(digits(stop));
        if (stop == first || stop - first > always_fits || !is_field(stop)) return any_marker(what);
        take(stop);
        return static_cast<std::int32_t>(negative ? -value : value);
    }
    /// A finite number.
    [[nodiscard]] double real(std::string_view what);
    /// A number that a coordinate can be.
    [[nodiscard]] double coordinate(std::string_view what);

    /// Refuses anything that is left on the line, after `expected` fields.
    void expect_end(std::size_t expected) const;

private:
    void skip_blanks() {
        while (next_ != end_ && (*next_ == ' ' || *next_ == '\t' || *next_ == '\r')) ++next_;
    }
    /// Goes on behind digits, up to so many that their value always fits.
    std::uint64_t digits(const char*& stop) const {
        constexpr std::ptrdiff_t always_fits = 19;
        const char* const last = end_ - stop > always_fits ? stop + always_fits : end_;
        std::uint64_t value = 0;
        for (; stop != last && *stop >= '0' && *stop <= '9'; ++stop) {
            value = 10 * value + static_cast<std::uint64_t>(*stop - '0');
        }
        return value;
    }
    /// Does the next field end here?
    [[nodiscard]] bool is_field(const char* stop) const {
        return stop != next_ && (stop == end_ || is_blank(*stop));
    }
    void take(const char* stop) {
        next_ = stop;
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
