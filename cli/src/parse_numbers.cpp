#include "parse_numbers.hpp"

#include <cmath>
#include <concepts>
#include <cstdint>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/from_chars.hpp>

namespace octetra::cli {
namespace {

/// Removes a number from the beginning of [next, end).
template <class Number>
std::errc take_number(const char*& next, const char* end, Number& number) {
    if (next != end && *next == '+' && next + 1 != end && next[1] != '-') ++next;
    const auto [stop, error] = from_chars(next, end, number);
    next = stop;
    return error;
}

}  // namespace

template <class Number>
Number parse_number(std::string_view option, std::string_view text, const Range<Number>& range) {
    Number number{};
    const char* next = text.data();
    const char* const end = next + text.size();
    const std::errc error = take_number(next, end, number);
    // NaN is neither less nor greater.
    if (error == std::errc{} && next == end && number >= range.low && number <= range.high) {
        return number;
    }
    const bool too_far = error == std::errc::result_out_of_range && next == end;
    throw InputError(fmt::format("{} takes a {} {}{}, not '{}'{}", option,
                                 std::integral<Number> ? "whole number" : "number", range.before,
                                 range.words, text, too_far ? "; it is out of range" : ""));
}

template double parse_number(std::string_view, std::string_view, const Range<double>&);
template std::int32_t parse_number(std::string_view, std::string_view, const Range<std::int32_t>&);
template std::uint64_t parse_number(std::string_view, std::string_view,
                                    const Range<std::uint64_t>&);

std::vector<double> parse_reals(const std::string& text, std::size_t count, std::string_view option,
                                std::string_view form) {
    std::vector<double> numbers;
    const char* next = text.data();
    const char* const end = next + text.size();
    bool another = true;  // whether a comma announces another number
    while (another) {
        double number = 0;
        if (take_number(next, end, number) != std::errc{} || !std::isfinite(number)) break;
        numbers.push_back(number);
        another = next != end && *next == ',';
        if (another) ++next;
    }
    if (another || next != end || numbers.size() != count) {
        throw InputError(
            fmt::format("{} takes {} finite numbers as {}, not '{}'", option, count, form, text));
    }
    return numbers;
}

}  // namespace octetra::cli
