#pragma once

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

namespace octetra::cli {

/// What an option takes that is a number from `low` to `high`, which `range` says in words, as in
/// "0 to 50". Any other text is refused as "'text' is not a number from 0 to 50".
[[nodiscard]] CLI::Validator number(double low, double high, const std::string& range);
[[nodiscard]] CLI::Validator whole_number(std::uint64_t low, std::uint64_t high,
                                          const std::string& range);

}  // namespace octetra::cli
