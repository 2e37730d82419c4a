#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include <octetra/core/error.hpp>
#include <octetra/core/process_group.hpp>

/// Functions by which processes that read a file together find their shares. In a text file, a line
/// belongs to the process in whose share of the bytes it begins, and the number of lines of lower
/// ranks is the number of the first entity. In a Medit text file all processes search for the lines
/// with keywords first (keyword_scan.hpp). In a binary Medit file the counts of rows determine the
/// shares. In a Gmsh file nodes and elements are in blocks whose positions are known only from the
/// blocks before, so the first process reads the headers of all blocks; rows of text are located by
/// counts of lines (line_index.hpp).
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

/// Returns the capacity to reserve for a process's share of a list of `count` entities:
/// proportional to its bytes, plus a quarter, because some lines are shorter. Unused capacity
/// occupies no memory.
[[nodiscard]] inline std::uint64_t room_for(std::uint64_t count, const FileRange& share,
                                            const FileRange& whole) {
    if (whole.size() == 0) return 0;
    const double entities = static_cast<double>(count) * static_cast<double>(share.size()) /
                            static_cast<double>(whole.size());
    return std::min(count, static_cast<std::uint64_t>(1.25 * entities) + 16);
}

/// Collective. Returns the number of this process's first entity, the sum of `read` over lower
/// ranks. Throws InputError on all processes if the total differs from the announced number.
[[nodiscard]] inline std::uint64_t number_share(const ProcessGroup& group, std::uint64_t read,
                                                std::uint64_t announced) {
    if (group.sum(read) != announced) throw InputError("the count differs from the announced one");
    return group.sum_before(read);
}

}  // namespace octetra
