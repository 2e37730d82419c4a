#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "files/shares/status.hpp"

namespace octetra {

/// A line of a file: its position in bytes, and its number, counted from 1.
struct NumberedLine {
    std::uint64_t position = 0;
    std::uint64_t number = 0;
};

/// Collective. Returns the lines of a file whose first token begins with a letter, ascending. Each
/// process scans its share, and all exchange the results. Returns nothing on all processes if one
/// has failed, or if there are more than any mesh has.
[[nodiscard]] std::optional<std::vector<NumberedLine>> scan_for_keywords(
    CollectiveStatus& status, const std::filesystem::path& path, std::uint64_t file_size);

}  // namespace octetra
