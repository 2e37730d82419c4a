#pragma once

#include <cstdint>
#include <filesystem>

#include <octetra/core/process_group.hpp>

namespace octetra {

/// Bytes begin .. end-1 of a file.
struct FileStretch {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;

    [[nodiscard]] std::uint64_t size() const { return end - begin; }
};

/// The lines of a stretch, at whose beginning one begins, that a process is to read: those that
/// begin in its even share of the bytes. Looks for the ends of lines, and asks nobody.
[[nodiscard]] FileStretch share_of_lines(const std::filesystem::path& path,
                                         const FileStretch& whole, int rank, int processes);

/// Rows of which this process reads its even share; where they are follows from their number.
struct RowShare {
    std::uint64_t first = 0;
    std::uint64_t count = 0;
};
[[nodiscard]] RowShare share_of_rows(std::uint64_t count, const ProcessGroup& group);
/// The share of the process `rank`.of so many.
[[nodiscard]] RowShare share_of_rows(std::uint64_t count, int rank, int size);

}  // namespace octetra
