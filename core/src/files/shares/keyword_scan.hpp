#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <octetra/core/process_group.hpp>

namespace octetra {

/// A line of a file: its position in bytes, and its number, counted from 1.
struct NumberedLine {
    std::uint64_t position = 0;
    std::uint64_t number = 0;
};

/// Collective, within a transaction. Returns the lines of a file whose first token begins with a
/// letter, ascending. Each process scans its share, and all exchange the results. Throws if there
/// are more than any mesh has.
[[nodiscard]] std::vector<NumberedLine> scan_for_keywords(const ProcessGroup& group,
                                                          const std::filesystem::path& path,
                                                          std::uint64_t file_size);

}  // namespace octetra
