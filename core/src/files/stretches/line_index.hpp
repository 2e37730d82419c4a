#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "files/stretches/progress.hpp"

namespace octetra {

/// Where lines of a text file begin: how many end in each of equally long stretches of the file is
/// kept, a megabyte at most, and the rest looked up. Lines are counted from 1, empty ones too.
class LineIndex {
public:
    /// Collective. Each process counts in its share. Nothing, on all processes, if something has
    /// failed.
    [[nodiscard]] static std::optional<LineIndex> make(Progress& progress,
                                                       const std::filesystem::path& path,
                                                       std::uint64_t file_size);

    /// Throws std::out_of_range if the file has no such line.
    [[nodiscard]] std::uint64_t position_of(std::uint64_t line) const;
    /// Somewhere before the line, and not far: costs no look at the file.
    [[nodiscard]] std::uint64_t position_before(std::uint64_t line) const;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::uint64_t file_size() const { return file_size_; }

private:
    LineIndex(std::filesystem::path path, std::uint64_t file_size);

    /// The stretch in which the line before this one ends.
    [[nodiscard]] std::uint64_t stretch_before(std::uint64_t line) const;

    std::filesystem::path path_;
    std::uint64_t file_size_ = 0;
    std::uint64_t stretch_ = 0;               // in bytes
    std::vector<std::uint64_t> ends_before_;  // how many lines end before each stretch; and all
};

}  // namespace octetra
