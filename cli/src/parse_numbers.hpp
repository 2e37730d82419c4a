#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Numbers on the command line, as in mesh files: decimal, with nothing before or after them, and
/// none that only becomes one by overflow or underflow.
namespace octetra::cli {

/// What an option takes: numbers from `low` to `high`, which `words` says, as in "0 to 50".
template <class Number>
struct Range {
    Number low;
    Number high;
    std::string words;
};

/// The number that `text` is as the value of `option`: a double, or a whole number of 32 or 64
/// bits. Throws InputError, which says what the option takes and that it is not `text`.
template <class Number>
[[nodiscard]] Number parse_number(std::string_view option, std::string_view text,
                                  const Range<Number>& range);

/// The `count` finite numbers of "1,2.5,-3". `option` and `form` are for the InputError that
/// anything else gets, as in `--sphere X,Y,Z,R`.
[[nodiscard]] std::vector<double> parse_reals(const std::string& text, std::size_t count,
                                              std::string_view option, std::string_view form);

}  // namespace octetra::cli
