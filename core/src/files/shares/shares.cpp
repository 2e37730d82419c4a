#include "files/shares/shares.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "files/input/input_file.hpp"

namespace octetra {
namespace {

/// Returns the position of the first line that begins at `position` or later.
std::uint64_t next_line(const InputFile& file, std::uint64_t position, const FileRange& whole) {
    if (position <= whole.begin) return whole.begin;
    std::array<char, 4096> bytes;
    for (--position; position < whole.end;) {  // the preceding line end may be the last byte
        const auto size = std::min<std::uint64_t>(bytes.size(), whole.end - position);
        file.read(position, bytes.data(), size);
        if (const void* found = std::memchr(bytes.data(), '\n', size)) {
            const auto offset = static_cast<const char*>(found) - bytes.data();
            return position + static_cast<std::uint64_t>(offset) + 1;
        }
        position += size;
    }
    return whole.end;
}

}  // namespace

FileRange share_of_lines(const std::filesystem::path& path, const FileRange& whole, int rank,
                         int processes) {
    const InputFile file(path);
    const auto count = static_cast<std::uint64_t>(processes);
    const auto boundary = [&](int r) {
        const auto shares = static_cast<std::uint64_t>(r);
        return next_line(
            file,
            whole.begin + whole.size() / count * shares + std::min(whole.size() % count, shares),
            whole);
    };
    return {boundary(rank), boundary(rank + 1)};
}

RowShare share_of_rows(std::uint64_t count, const ProcessGroup& group) {
    return share_of_rows(count, group.rank(), group.size());
}

RowShare share_of_rows(std::uint64_t count, int rank, int size) {
    const auto processes = static_cast<std::uint64_t>(size);
    const auto begin = [&](int of_rank) {
        const auto r = static_cast<std::uint64_t>(of_rank);
        return count / processes * r + std::min(count % processes, r);
    };
    return {begin(rank), begin(rank + 1) - begin(rank)};
}

}  // namespace octetra
