#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Numbers on the command line, with the same syntax as in mesh files: decimal, without surrounding
/// text, and without overflow or underflow.
namespace octetra::cli {

/// The range of an option: numbers from `low` to `high`, described by `words`, as in "0 to 50", and
/// in a sentence by `before` and `words`.
template <class Number>
struct Range {
    Number low;
    Number high;
    std::string words;
    std::string before = "from ";
};

/// Parses `text` as the value of `option`: a double, or an integer of 32 or 64 bits. Throws
/// InputError, which states the valid range and `text`.
template <class Number>
[[nodiscard]] Number parse_number(std::string_view option, std::string_view text,
                                  const Range<Number>& range);

/// Parses "1,2.5,-3" into `count` finite numbers. Throws InputError, which contains `option` and
/// `form`, as in `--sphere X,Y,Z,R`.
[[nodiscard]] std::vector<double> parse_reals(const std::string& text, std::size_t count,
                                              std::string_view option, std::string_view form);

}  // namespace octetra::cli
