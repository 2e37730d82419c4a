#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace octetra::cli {

/// Returns two lines: the error in a rejected command line, and where to find help.
[[nodiscard]] std::string usage_error(const CLI::App& program, const CLI::ParseError& error);

/// Returns the first of the two lines.
[[nodiscard]] std::string usage_fault(const CLI::App& program, const CLI::ParseError& error);

/// Returns "; did you mean NAME?" with the closest of these names, or an empty string.
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       const std::vector<std::string>& names);

}  // namespace octetra::cli
