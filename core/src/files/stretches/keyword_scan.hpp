#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "files/stretches/progress.hpp"

namespace octetra {

/// A line of a file: where it begins, and its number, counted from 1.
struct NumberedLine {
    std::uint64_t position = 0;
    std::uint64_t number = 0;
};

/// Collective. The lines of a file whose first token begins with a letter, ascending: each
/// process looks through its share, and all tell each other. Nothing, on all processes, if
/// something has failed, or there are more than any mesh has.
[[nodiscard]] std::optional<std::vector<NumberedLine>> scan_for_keywords(
    Progress& progress, const std::filesystem::path& path, std::uint64_t file_size);

}  // namespace octetra
