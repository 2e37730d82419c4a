#include "edge_stars.hpp"

#include <numeric>

namespace octetra::distributed {

EdgeStars::EdgeStars(std::size_t vertex_count, const IndexVector<CellIndex, CellVertices>& cells)
    : begin_(vertex_count + 1, 0), cell_to_edges_(cells.size()) {
    for (const CellVertices& cell : cells) {
        for (const auto& [i, j] : cell_edges) ++begin_[std::min(cell[i], cell[j]).value()];
    }
    std::exclusive_scan(begin_.begin(), begin_.end(), begin_.begin(), 0U);
    end_.assign(begin_.begin(), begin_.end() - 1);
    high_end_.resize(6 * cells.size());

    for (CellIndex c{0}; c < cells.end_index(); ++c) {
        const CellVertices& cell = cells[c];
        for (std::size_t e = 0; e < 6; ++e) {
            const auto [low, high] = std::minmax(cell[cell_edges[e][0]], cell[cell_edges[e][1]]);
            const std::uint32_t slot = find_slot(low, high);
            if (slot == end_[low.value()]) {
                high_end_[slot] = high;
                ++end_[low.value()];
                if (slot - begin_[low.value()] >= searched)
                    hub_edges_.emplace(key(low, high), slot);
            }
            cell_to_edges_[c][e] = EdgeIndex{slot};
        }
    }
}

}  // namespace octetra::distributed
