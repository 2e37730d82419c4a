#pragma once

#include <cstdint>
#include <string>

namespace octetra::cli {

/// A count for people: 1234567 as "1,234,567".
[[nodiscard]] std::string grouped(std::uint64_t count);

}  // namespace octetra::cli
