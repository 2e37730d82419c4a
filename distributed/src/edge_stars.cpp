#include "edge_stars.hpp"

#include <numeric>

#include "huge_pages.hpp"

namespace octetra::distributed {

EdgeStars::EdgeStars(std::size_t vertex_count, const IndexVector<CellIndex, CellVertices>& cells)
    : begin_(vertex_count + 1, 0) {
    for (const CellVertices& cell : cells) {
        for (const auto& [i, j] : cell_edges) ++begin_[std::min(cell[i], cell[j]).value()];
    }
    std::exclusive_scan(begin_.begin(), begin_.end(), begin_.begin(), 0U);
    close_gaps(fill_buckets(cells), cells);
}

/// Lists every edge once, at the beginning of a bucket that has as many slots as there are cells at
/// its edges, so that it never overflows. Returns where each bucket's list ends.
std::vector<std::uint32_t> EdgeStars::fill_buckets(
    const IndexVector<CellIndex, CellVertices>& cells) {
    std::vector<std::uint32_t> end(begin_.begin(), begin_.end() - 1);
    const std::size_t slots = 6 * cells.size() + read_beyond;
    reserve_in_huge_pages(high_end_, slots);
    high_end_.resize(slots);
    reserve_in_huge_pages(cell_to_edges_, cells.size());
    for (const CellVertices& cell : cells) {
        std::array<EdgeIndex, 6> edges;
        for (std::size_t e = 0; e < 6; ++e) {
            const auto [low, high] = std::minmax(cell[cell_edges[e][0]], cell[cell_edges[e][1]]);
            const std::uint32_t begin = begin_[low.value()];
            const std::uint32_t slot = find_slot(low, high, begin, end[low.value()]);
            if (slot == end[low.value()]) {
                high_end_[slot] = high;
                ++end[low.value()];
                if (slot - begin >= searched) hub_edges_.emplace(key(low, high), slot);
            }
            edges[e] = EdgeIndex{slot};
        }
        cell_to_edges_.push_back(edges);
    }
    return end;
}

/// Moves the lists together.
void EdgeStars::close_gaps(const std::vector<std::uint32_t>& end,
                           const IndexVector<CellIndex, CellVertices>& cells) {
    std::vector<std::uint32_t> shift(end.size());
    std::uint32_t filled = 0;
    for (std::size_t low = 0; low < end.size(); ++low) {
        const std::uint32_t begin = begin_[low];
        shift[low] = begin - filled;
        begin_[low] = filled;
        for (std::uint32_t slot = begin; slot < end[low]; ++slot) {
            high_end_[filled++] = high_end_[slot];
        }
    }
    begin_.back() = filled;
    high_end_.resize(filled + read_beyond);
    high_end_.shrink_to_fit();

    for (CellIndex c{0}; c < cells.end_index(); ++c) {
        for (std::size_t e = 0; e < 6; ++e) {
            const VertexIndex low =
                std::min(cells[c][cell_edges[e][0]], cells[c][cell_edges[e][1]]);
            EdgeIndex& edge = cell_to_edges_[c][e];
            edge = EdgeIndex{edge.value() - shift[low.value()]};
        }
    }
    for (auto& [key, slot] : hub_edges_) slot -= shift[key >> 32U];
}

}  // namespace octetra::distributed
