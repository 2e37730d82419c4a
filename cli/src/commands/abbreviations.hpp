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

[[nodiscard]] const std::array<Abbreviation, 6>& abbreviations();

}  // namespace octetra::cli
