#include "parse_numbers.hpp"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

namespace octetra::cli {

std::vector<double> parse_reals(const std::string& text, std::size_t count, std::string_view option,
                                std::string_view form) {
    std::vector<double> numbers;
    const char* next = text.data();
    const char* const end = next + text.size();
    bool another = true;  // a comma asks for another number
    while (another) {
        double number = 0;
        if (next != end && *next == '+' && next + 1 != end && next[1] != '-') ++next;
        const auto [stop, error] = std::from_chars(next, end, number);
        if (error != std::errc{} || !std::isfinite(number)) break;
        numbers.push_back(number);
        next = stop;
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
