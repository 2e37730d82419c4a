#include "files/input/fields.hpp"

#include <cmath>
#include <limits>
#include <system_error>

#include <fmt/format.h>

#include <octetra/core/from_chars.hpp>
#include <octetra/core/point.hpp>

namespace octetra {
namespace {

std::string_view token_at(const char* first, const char* end) {
    const char* last = first;
    while (last != end && !is_blank(*last)) ++last;
    return {first, static_cast<std::size_t>(last - first)};
}

}  // namespace

std::string shown(std::string_view token) {
    constexpr std::size_t longest = 40;
    std::string out = "'";
    for (const char c : token.substr(0, longest)) {
        const auto byte = static_cast<unsigned char>(c);
        const bool printable = byte >= 0x20 && byte < 0x7f;
        out += printable ? std::string(1, c) : fmt::format("\\x{:02x}", byte);
    }
    return out + (token.size() > longest ? "...'" : "'");
}

std::string not_finite(std::string_view what, std::string_view number) {
    return fmt::format("{} is not finite: {}", what, number);
}

std::string too_large(std::string_view what, std::string_view number) {
    return fmt::format(
        "{} is {}: coordinates must be less than 2^1023, about 8.98e307, or midpoints overflow; "
        "scale the mesh down",
        what, number);
}

std::size_t Fields::count_left() const {
    Fields rest = *this;
    std::size_t count = 0;
    while (!rest.text().empty()) ++count;
    return count;
}

std::string_view Fields::text() {
    const std::string_view token = token_at(next_, end_);
    next_ += token.size();
    skip_blanks();
    return token;
}

template <class Number>
Number Fields::number(std::string_view what, std::string_view kind) {
    if (at_end()) reader_->fail(fmt::format("{} is missing", what));
    const char* first = next_;
    if (*first == '+' && first + 1 != end_ && first[1] != '-') ++first;
    Number value{};
    const auto [stop, error] = from_chars(first, end_, value);
    const bool whole_token = stop == end_ || is_blank(*stop);
    if (error == std::errc::result_out_of_range && whole_token) {
        reader_->fail(fmt::format("{} is out of range: {}", what, shown(token_at(next_, end_))));
    }
    if (error != std::errc{} || !whole_token) {
        reader_->fail(
            fmt::format("{} should be {}, not {}", what, kind, shown(token_at(next_, end_))));
    }
    next_ = stop;
    skip_blanks();
    return value;
}

std::uint64_t Fields::any_unsigned_integer(std::string_view what) {
    return number<std::uint64_t>(what, "a whole number from 0");
}

std::int32_t Fields::any_marker(std::string_view what) {
    const char* const first = next_;
    // Programs that store attributes as reals also write whole ones as 2.0 or 2e0.
    const double value = real(what);
    const bool whole = value == std::trunc(value);
    if (!whole || value < std::numeric_limits<std::int32_t>::min() ||
        value > std::numeric_limits<std::int32_t>::max()) {
        reader_->fail(fmt::format("{} should be a whole number of 32 bits, not {}", what,
                                  shown(token_at(first, end_))));
    }
    return static_cast<std::int32_t>(value);
}

double Fields::real(std::string_view what) {
    const char* const first = next_;
    const double value = number<double>(what, "a number");
    if (!std::isfinite(value)) {
        reader_->fail(not_finite(what, shown(token_at(first, end_))));
    }
    return value;
}

double Fields::coordinate(std::string_view what) {
    const char* const first = next_;
    const double value = real(what);
    if (std::abs(value) >= coordinate_limit) {
        reader_->fail(too_large(what, shown(token_at(first, end_))));
    }
    return value;
}

void Fields::expect_end(std::size_t expected) const {
    if (at_end()) return;
    reader_->fail(fmt::format("{} fields expected, {} found; the first extra one is {}", expected,
                              expected + count_left(), shown(token_at(next_, end_))));
}

}  // namespace octetra
