#include "files/stretches/line_index.hpp"

#include <algorithm>
#include <cstring>
#include <span>
#include <stdexcept>
#include <utility>

#include "files/input/input_file.hpp"
#include "files/stretches/shares.hpp"

namespace octetra {
namespace {

constexpr std::uint64_t most_stretches = std::uint64_t{1} << 16U;
constexpr std::uint64_t least_stretch = 64;

/// Returns the number of line ends in each of these blocks.
std::vector<std::uint64_t> count_ends(const InputFile& file, std::uint64_t stretch,
                                      const RowShare& share) {
    std::vector<std::uint64_t> ends(share.count, 0);
    std::vector<char> bytes;
    const std::uint64_t at_once = std::max<std::uint64_t>(1, (std::uint64_t{1} << 18U) / stretch);
    for (std::uint64_t k = 0; k < share.count; k += at_once) {
        const std::uint64_t begin = (share.first + k) * stretch;
        const std::uint64_t count = std::min(at_once, share.count - k);
        bytes.resize(std::min(count * stretch, file.size() - begin));
        file.read(begin, bytes.data(), bytes.size());
        for (std::uint64_t i = 0; i < count; ++i) {
            const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(i * stretch);
            const auto length = std::min(static_cast<std::ptrdiff_t>(stretch), bytes.end() - from);
            ends[k + i] = static_cast<std::uint64_t>(std::count(from, from + length, '\n'));
        }
    }
    return ends;
}

}  // namespace

LineIndex::LineIndex(std::filesystem::path path, std::uint64_t file_size)
    : path_(std::move(path)),
      file_size_(file_size),
      stretch_(std::max(least_stretch, file_size / most_stretches + 1)) {}

std::optional<LineIndex> LineIndex::make(Progress& progress, const std::filesystem::path& path,
                                         std::uint64_t file_size) {
    const ProcessGroup& group = progress.group();
    std::optional<LineIndex> index;
    ProcessGroup::Bytes own;
    progress.attempt([&] {
        index = LineIndex(path, file_size);
        const std::uint64_t stretches = (file_size + index->stretch_ - 1) / index->stretch_;
        const std::vector<std::uint64_t> ends =
            count_ends(InputFile(path), index->stretch_, share_of_rows(stretches, group));
        const auto bytes = std::as_bytes(std::span(ends));
        own.assign(bytes.begin(), bytes.end());
    });
    if (!progress.all_well()) return std::nullopt;
    progress.attempt([&] {
        const std::vector<ProcessGroup::Bytes> of_all = group.of_all(std::move(own));
        std::uint64_t sum = 0;
        index->ends_before_.push_back(sum);
        for (const ProcessGroup::Bytes& bytes : of_all) {
            std::vector<std::uint64_t> ends(bytes.size() / sizeof(std::uint64_t));
            if (ends.empty()) continue;
            std::memcpy(ends.data(), bytes.data(), bytes.size());
            for (const std::uint64_t count : ends) index->ends_before_.push_back(sum += count);
        }
    });
    if (!progress.all_well()) return std::nullopt;
    return index;
}

std::uint64_t LineIndex::stretch_before(std::uint64_t line) const {
    if (line == 0 || line - 1 > ends_before_.back()) throw std::out_of_range("no such line");
    const auto after = std::ranges::lower_bound(ends_before_, line - 1);
    return static_cast<std::uint64_t>(
        std::max<std::ptrdiff_t>(after - ends_before_.begin() - 1, 0));
}

std::uint64_t LineIndex::position_before(std::uint64_t line) const {
    return line == 1 ? 0 : stretch_before(line) * stretch_;
}

std::uint64_t LineIndex::position_of(std::uint64_t line) const {
    if (line == 1) return 0;
    const std::uint64_t stretch = stretch_before(line);
    const std::uint64_t begin = stretch * stretch_;
    const InputFile file(path_);
    const auto bytes = file.read(begin, std::min(stretch_, file_size_ - begin));
    std::uint64_t left = line - 1 - ends_before_[stretch];
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        if (bytes[k] == std::byte{'\n'} && --left == 0) return begin + k + 1;
    }
    throw std::out_of_range("the file has changed while it was read");
}

}  // namespace octetra
