#pragma once

#include <charconv>

namespace octetra {

/// std::from_chars(first, last, number) for standard libraries without that function for double,
/// such as libc++ 19: by strtod() in the locale "C", with the same results.
std::from_chars_result from_chars_by_strtod(const char* first, const char* last, double& number);

/// std::from_chars(first, last, number), also where the standard library has none for double.
template <class Number>
std::from_chars_result from_chars(const char* first, const char* last, Number& number) {
    if constexpr (requires { std::from_chars(first, last, number); }) {
        return std::from_chars(first, last, number);
    } else {
        return from_chars_by_strtod(first, last, number);
    }
}

}  // namespace octetra
