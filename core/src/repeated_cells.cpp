#include <octetra/core/repeated_cells.hpp>

#include <algorithm>
#include <utility>

#include <octetra/core/huge_pages.hpp>

namespace octetra {
namespace {

CellVertices sorted(CellVertices cell) {
    std::ranges::sort(cell);
    return cell;
}

/// A cell and its vertices, ascending.
using ByVertices = std::pair<CellVertices, CellIndex>;

}  // namespace

RepeatedCells::RepeatedCells(std::uint64_t cell_count) : word_count_(cell_count / 4 + 1) {
    reserve_in_huge_pages(seen_, word_count_);  // random access
    seen_.resize(word_count_, 0);
}

/// Looks up all waiting cells.
void RepeatedCells::look_up() {
    for (std::uint32_t i = 0; i < pending_count_; ++i) {
        std::uint64_t& word = seen_[pending_[i].word];
        const std::uint64_t bits = pending_[i].bits;
        if ((word & bits) == bits) suspects_.push_back(CellIndex{count_ + i});
        word |= bits;
    }
    count_ += std::exchange(pending_count_, 0);
}

CellPair RepeatedCells::find(const IndexVector<CellIndex, CellVertices>& cells,
                             std::size_t vertex_count) {
    look_up();
    std::vector<std::uint64_t>().swap(seen_);
    if (suspects_.empty()) return {};

    std::vector<ByVertices> suspects;
    std::vector<std::uint8_t> is_corner(vertex_count, 0);
    for (const CellIndex c : suspects_) {
        suspects.emplace_back(sorted(cells[c]), c);
        for (const VertexIndex v : cells[c]) is_corner[v.value()] = 1;
    }
    std::ranges::sort(suspects);
    CellPair pair;
    for (CellIndex c{0}; c < cells.end_index(); ++c) {
        const CellVertices& cell = cells[c];
        std::uint8_t are_corners = 1;  // branch-free
        for (const VertexIndex v : cell) are_corners &= is_corner[v.value()];
        if (are_corners == 0) continue;
        // The first suspect with these vertices after this cell.
        const ByVertices wanted{sorted(cell), c};
        const auto later = std::ranges::upper_bound(suspects, wanted);
        if (later == suspects.end() || later->first != wanted.first) continue;
        if (later->second < pair.cell) pair = {later->second, c};
    }
    return pair;
}

}  // namespace octetra
