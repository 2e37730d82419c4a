#include "commands/number_checks.hpp"

#include <charconv>
#include <string_view>

#include <fmt/format.h>

namespace octetra::cli {
namespace {

template <class T>
CLI::Validator check(T low, T high, std::string_view what, const std::string& range) {
    const auto refusal = [=](const std::string& text) {
        T value{};
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, value);
        // Not a number is neither less nor greater.
        if (error == std::errc{} && stop == end && value >= low && value <= high) {
            return std::string();
        }
        return fmt::format("'{}' is not {} from {}", text, what, range);
    };
    return {refusal, range};
}

}  // namespace

CLI::Validator number(double low, double high, const std::string& range) {
    return check(low, high, "a number", range);
}

CLI::Validator whole_number(std::uint64_t low, std::uint64_t high, const std::string& range) {
    return check(low, high, "a whole number", range);
}

}  // namespace octetra::cli
