#include <octetra/core/cut_runs.hpp>

#include <bit>

namespace octetra {

std::size_t child_count_of(Cut cut) {
    if (cut == 0) return 1;
    const auto edges = static_cast<unsigned>(cut & cut_edges);
    return static_cast<std::size_t>(std::popcount(edges)) + 1U + (cut >> 6U);
}

void append_number(std::uint64_t number, std::vector<std::uint8_t>& bytes) {
    for (; number >= 128; number >>= 7U) {
        bytes.push_back(static_cast<std::uint8_t>(128U | (number & 127U)));
    }
    bytes.push_back(static_cast<std::uint8_t>(number));
}

bool take_number(std::span<const std::uint8_t>& bytes, std::uint64_t& number) {
    number = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
        if (bytes.empty()) return false;
        const std::uint8_t byte = bytes.front();
        bytes = bytes.subspan(1);
        const std::uint64_t bits = std::uint64_t{byte & 127U} << shift;
        if (bits >> shift != (byte & 127U)) return false;
        number |= bits;
        if (byte < 128) return true;
    }
    return false;
}

void CutRuns::append(Cut cut, std::uint64_t count) {
    if (count == 0) return;  // lets the runs around it be merged
    if (cut != cut_) {
        write_run();
        cut_ = cut;
    }
    count_ += count;
}

void CutRuns::write_run() {
    if (count_ == 1) bytes_.push_back(cut_);
    if (count_ > 1) {
        bytes_.push_back(static_cast<std::uint8_t>(cut_ | 128U));
        append_number(count_ - 2, bytes_);
    }
    count_ = 0;
}

CutRun CutReader::next() {
    const std::uint8_t first = rest_.front();
    rest_ = rest_.subspan(1);
    const auto cut = static_cast<Cut>(first & 127U);
    if (cut == one_child_more) return {};  // no cell: no edges, an invalid cut
    if (first < 128) return {cut, 1};
    std::uint64_t more = 0;
    if (!take_number(rest_, more) || more > (std::uint64_t{1} << 62U)) return {};
    return {cut, more + 2};
}

}  // namespace octetra
