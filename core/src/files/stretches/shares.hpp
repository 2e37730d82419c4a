#pragma once

#include <cstdint>
#include <filesystem>

#include <octetra/core/process_group.hpp>

namespace octetra {

/// Bytes begin .. end - 1 of a file.
struct FileRange {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;

    [[nodiscard]] std::uint64_t size() const { return end - begin; }
};

/// Returns the lines that a process is to read of a byte range, which must begin with a line: those
/// that begin in its even share of the bytes. Reads the file to find line ends. Not collective.
[[nodiscard]] FileRange share_of_lines(const std::filesystem::path& path, const FileRange& whole,
                                       int rank, int processes);

/// A process's even share of the rows of a list whose row positions follow from their numbers.
struct RowShare {
    std::uint64_t first = 0;
    std::uint64_t count = 0;
};
[[nodiscard]] RowShare share_of_rows(std::uint64_t count, const ProcessGroup& group);
/// Returns the share of the process `rank` of `size` processes.
[[nodiscard]] RowShare share_of_rows(std::uint64_t count, int rank, int size);

}  // namespace octetra
