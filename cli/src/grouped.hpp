#pragma once

#include <cstdint>
#include <string>

namespace octetra::cli {

/// Formats a count with separators: 1234567 as "1,234,567".
[[nodiscard]] std::string grouped(std::uint64_t count);

}  // namespace octetra::cli
