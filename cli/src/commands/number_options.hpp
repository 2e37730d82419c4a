#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "parse_numbers.hpp"

namespace octetra::cli {

/// The range of integers from `low` on.
[[nodiscard]] inline Range<std::uint64_t> whole_numbers_from(std::uint64_t low) {
    return {low, std::numeric_limits<std::uint64_t>::max(), std::to_string(low) + " up"};
}

template <class To>
void assign(To& to, auto number) {
    to = static_cast<To>(number);
}
template <class To>
void assign(std::optional<To>& to, auto number) {
    to = static_cast<To>(number);
}

/// Declares an option whose value is a number, stored in `value`. CLI11's own conversion would read
/// 010 as 8, 0x10 as 16 and 1e-400 as 0.
template <class Number, class Value>
CLI::Option* add_number(CLI::App& command, const std::string& names, Value& value,
                        const Range<Number>& range, const std::string& description) {
    const std::string name = names.substr(names.rfind(',') + 1);
    const auto parse = [&value, name, range](const CLI::results_t& given) {
        assign(value, parse_number(name, given.front(), range));
        return true;
    };
    CLI::Option* option = command.add_option(names, parse, description);
    // This validator only adds the range to the help.
    option->check({[](const std::string&) { return std::string(); }, range.words});
    return option;
}

}  // namespace octetra::cli
