#include "length_order.hpp"

#include <octetra/core/edge_order.hpp>

namespace octetra::distributed {

LengthOrder length_order(const IndexVector<VertexIndex, Point>& points, const CellVertices& cell) {
    std::array<Segment, 6> segments;
    std::array<double, 6> lengths;
    for (std::size_t e = 0; e < 6; ++e) {
        segments[e] = {points[cell[cell_edges[e][0]]], points[cell[cell_edges[e][1]]]};
        lengths[e] = squared_length(segments[e]);
    }
    unsigned comparisons = 0;
    unsigned ties = 0;
    unsigned pair = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = i + 1; j < 6; ++j, ++pair) {
            comparisons |= static_cast<unsigned>(lengths[i] > lengths[j]) << pair;
            ties |= static_cast<unsigned>(lengths[i] == lengths[j]) << pair;
        }
    }
    if (ties != 0) {
        pair = 0;
        for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t j = i + 1; j < 6; ++j, ++pair) {
                if ((ties >> pair & 1U) == 0) continue;
                comparisons |= static_cast<unsigned>(longer(segments[i], segments[j])) << pair;
            }
        }
    }
    return PatternTable::get().order(static_cast<Comparisons>(comparisons));
}

}  // namespace octetra::distributed
