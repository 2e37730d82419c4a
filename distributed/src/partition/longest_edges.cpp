#include "partition/longest_edges.hpp"

#include <numeric>

#include "pattern/length_order.hpp"

namespace octetra::distributed {

LongestEdges::LongestEdges(const Mesh& mesh)
    : cells_of_mesh_(&mesh.cells), position_(mesh.cells.size()), cells_(mesh.cells.size()) {
    std::vector<std::uint32_t> bucket(mesh.points.size() + 1, 0);  // by the lower end
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const LengthOrder order = length_order(mesh.points, mesh.cells[c]);
        position_[c] = static_cast<std::uint8_t>(PatternTable::get().longest_edge(order));
        ++bucket[longest_of(c).front().value()];
    }
    std::inclusive_scan(bucket.begin(), bucket.end(), bucket.begin());
    // Filled in reverse, which leaves each offset at the begin of its range.
    for (std::size_t c = mesh.cells.size(); c-- > 0;) {
        cells_[--bucket[longest_of(CellIndex{c}).front().value()]] = CellIndex{c};
    }
    for (VertexIndex low{0}; low < mesh.points.end_index(); ++low) {
        const auto begin = cells_.begin() + bucket[low.value()];
        const auto end = cells_.begin() + bucket[low.value() + 1U];
        std::sort(begin, end, [&](CellIndex a, CellIndex b) {
            return std::pair{longest_of(a).back(), a} < std::pair{longest_of(b).back(), b};
        });
        for (auto cell = begin; cell != end; ++cell) {
            const EdgeVertices edge = longest_of(*cell);
            if (cell != begin && ends_.back() == edge) continue;
            ends_.push_back(edge);
            begin_.push_back(static_cast<std::uint32_t>(cell - cells_.begin()));
        }
    }
    begin_.push_back(static_cast<std::uint32_t>(cells_.size()));
}

}  // namespace octetra::distributed
