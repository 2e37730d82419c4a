#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace octetra::cli {

/// What is wrong with a command line that was refused, and where to read more, in two lines.
[[nodiscard]] std::string usage_error(const CLI::App& program, const CLI::ParseError& error);

/// The first of the two.
[[nodiscard]] std::string usage_fault(const CLI::App& program, const CLI::ParseError& error);

/// "; did you mean NAME?" of the name among these that somebody may have meant, or nothing.
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       const std::vector<std::string>& names);

}  // namespace octetra::cli
