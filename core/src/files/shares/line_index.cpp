#include "files/shares/line_index.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

#include "files/input/input_file.hpp"
#include "files/shares/gather.hpp"
#include "files/shares/shares.hpp"

namespace octetra {
namespace {

constexpr std::uint64_t max_blocks = std::uint64_t{1} << 16U;
constexpr std::uint64_t min_block_size = 64;

/// Returns the number of line ends in each of these blocks.
std::vector<std::uint64_t> count_ends(const InputFile& file, std::uint64_t block,
                                      const RowShare& share) {
    std::vector<std::uint64_t> ends(share.count, 0);
    std::vector<char> bytes;
    const std::uint64_t at_once = std::max<std::uint64_t>(1, (std::uint64_t{1} << 18U) / block);
    for (std::uint64_t k = 0; k < share.count; k += at_once) {
        const std::uint64_t begin = (share.first + k) * block;
        const std::uint64_t count = std::min(at_once, share.count - k);
        bytes.resize(std::min(count * block, file.size() - begin));
        file.read(begin, bytes.data(), bytes.size());
        for (std::uint64_t i = 0; i < count; ++i) {
            const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(i * block);
            const auto length = std::min(static_cast<std::ptrdiff_t>(block), bytes.end() - from);
            ends[k + i] = static_cast<std::uint64_t>(std::count(from, from + length, '\n'));
        }
    }
    return ends;
}

}  // namespace

LineIndex::LineIndex(const ProcessGroup& group, std::filesystem::path path, std::uint64_t file_size)
    : path_(std::move(path)),
      file_size_(file_size),
      block_size_(std::max(min_block_size, file_size / max_blocks + 1)) {
    const std::uint64_t blocks = (file_size + block_size_ - 1) / block_size_;
    const std::vector<std::uint64_t> ends =
        count_ends(InputFile(path_), block_size_, share_of_rows(blocks, group));
    std::uint64_t sum = 0;
    ends_before_.push_back(sum);
    for (const auto& of_process : gather_lists(group, std::span<const std::uint64_t>(ends))) {
        for (const std::uint64_t count : of_process) ends_before_.push_back(sum += count);
    }
}

std::uint64_t LineIndex::block_before(std::uint64_t line) const {
    if (line == 0 || line - 1 > ends_before_.back()) throw std::out_of_range("no such line");
    const auto after = std::ranges::lower_bound(ends_before_, line - 1);
    return static_cast<std::uint64_t>(
        std::max<std::ptrdiff_t>(after - ends_before_.begin() - 1, 0));
}

std::uint64_t LineIndex::position_before(std::uint64_t line) const {
    return line == 1 ? 0 : block_before(line) * block_size_;
}

std::uint64_t LineIndex::position_of(std::uint64_t line) const {
    if (line == 1) return 0;
    const std::uint64_t block = block_before(line);
    const std::uint64_t begin = block * block_size_;
    const InputFile file(path_);
    const auto bytes = file.read(begin, std::min(block_size_, file_size_ - begin));
    std::uint64_t left = line - 1 - ends_before_[block];
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        if (bytes[k] == std::byte{'\n'} && --left == 0) return begin + k + 1;
    }
    throw std::out_of_range("the file has changed while it was read");
}

}  // namespace octetra
