#pragma once

#include <cstdint>
#include <filesystem>

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

}  // namespace octetra
