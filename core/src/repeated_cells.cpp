#include <octetra/core/repeated_cells.hpp>

#include <algorithm>
#include <utility>

namespace octetra {
namespace {

CellVertices sorted(CellVertices cell) {
    std::ranges::sort(cell);
    return cell;
}

/// A cell by its vertices, ascending.
using ByVertices = std::pair<CellVertices, CellIndex>;

}  // namespace

RepeatedCells::RepeatedCells(std::uint64_t cell_count) : seen_(cell_count / 4 + 1, 0) {}

CellPair RepeatedCells::find(const IndexVector<CellIndex, CellVertices>& cells,
                             std::size_t vertex_count) {
    for (std::uint32_t i = count_ - std::min(count_, ahead); i < count_; ++i) {
        look_up(waiting_[i % ahead], i);
    }
    std::vector<std::uint64_t>().swap(seen_);
    if (suspects_.empty()) return {};

    std::vector<ByVertices> suspects;
    std::vector<bool> is_corner(vertex_count, false);
    for (const CellIndex c : suspects_) {
        suspects.emplace_back(sorted(cells[c]), c);
        for (const VertexIndex v : cells[c]) is_corner[v.value()] = true;
    }
    std::ranges::sort(suspects);
    CellPair pair;
    for (CellIndex c{0}; c < cells.end_index(); ++c) {
        const CellVertices& cell = cells[c];
        if (!std::ranges::all_of(cell, [&](VertexIndex v) { return is_corner[v.value()]; })) {
            continue;
        }
        // The first suspect with these vertices that comes behind this cell.
        const ByVertices wanted{sorted(cell), c};
        const auto later = std::ranges::upper_bound(suspects, wanted);
        if (later == suspects.end() || later->first != wanted.first) continue;
        if (later->second < pair.cell) pair = {later->second, c};
    }
    return pair;
}

}  // namespace octetra
