#pragma once

#include <array>
#include <string>
#include <string_view>

namespace octetra::cli {

/// A criterion that stands for an expression of --where.
struct Abbreviation {
    std::string_view option;       ///< without dashes
    std::string_view type;         ///< of its value, in the help
    std::string_view description;  ///< in the help
    /// Returns the expression for a value. Throws InputError if the value is invalid.
    std::string (*expression)(const std::string& value);
};

/// Returns a name of a field or group in quotation marks. Throws InputError, which begins with the
/// option, if that is impossible.
[[nodiscard]] std::string quoted(std::string_view option, std::string_view name);

[[nodiscard]] const std::array<Abbreviation, 5>& abbreviations();

}  // namespace octetra::cli
