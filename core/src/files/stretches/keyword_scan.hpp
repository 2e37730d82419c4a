#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "files/stretches/progress.hpp"

namespace octetra {

/// Collective. Where lines of a file begin whose first token begins with a letter, ascending: each
/// process looks through its share, and all tell each other. Nothing, on all processes, if
/// something has failed, or there are more than any mesh has.
[[nodiscard]] std::optional<std::vector<std::uint64_t>> scan_for_keywords(
    Progress& progress, const std::filesystem::path& path, std::uint64_t file_size);

}  // namespace octetra
