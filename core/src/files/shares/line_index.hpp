#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <octetra/core/process_group.hpp>

namespace octetra {

/// Maps line numbers of a text file to positions. It stores the number of line ends in each of
/// equally long blocks of the file, in at most a megabyte, and reads a block to find a line. Lines
/// are counted from 1; empty ones count.
class LineIndex {
public:
    /// Collective, within a transaction. Each process counts line ends in its share.
    LineIndex(const ProcessGroup& group, std::filesystem::path path, std::uint64_t file_size);

    /// Throws std::out_of_range if the file has no such line.
    [[nodiscard]] std::uint64_t position_of(std::uint64_t line) const;
    /// Returns a position shortly before the line, without reading the file.
    [[nodiscard]] std::uint64_t position_before(std::uint64_t line) const;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::uint64_t file_size() const { return file_size_; }

private:
    /// Returns the block that contains the end of the preceding line.
    [[nodiscard]] std::uint64_t block_before(std::uint64_t line) const;

    std::filesystem::path path_;
    std::uint64_t file_size_ = 0;
    std::uint64_t block_size_ = 0;            // in bytes
    std::vector<std::uint64_t> ends_before_;  // number of line ends before each block; and in all
};

}  // namespace octetra
