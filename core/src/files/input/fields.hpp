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
    [[nodiscard]] std::uint64_t unsigned_integer(std::string_view what);
    [[nodiscard]] std::int32_t marker(std::string_view what);
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
    template <class Number>
    Number number(std::string_view what, std::string_view kind);

    const LineReader* reader_;
    const char* next_;
    const char* end_;
};

}  // namespace octetra
