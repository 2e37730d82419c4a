#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace octetra::cli {

/// What is wrong with a command line that was refused, and where to read more, in two lines.
[[nodiscard]] std::string usage_error(const CLI::App& program, const CLI::ParseError& error);

}  // namespace octetra::cli
