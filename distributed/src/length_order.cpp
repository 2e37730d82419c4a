#include "length_order.hpp"

#include <algorithm>

#include <octetra/core/edge_order.hpp>

namespace octetra::distributed {
namespace {

/// Decides between edges that are equally long, as longer() does: by the smaller end points, then
/// by the larger ones. Corners are in different places, so it comes to comparing their ranks.
std::array<unsigned, 6> keys_of(const std::array<Point, 4>& corners) {
    std::array<unsigned, 4> rank{};
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) ++rank[corners[i] < corners[j] ? j : i];
    }
    std::array<unsigned, 6> keys;
    for (std::size_t e = 0; e < 6; ++e) {
        const auto [low, high] = std::minmax(rank[cell_edges[e][0]], rank[cell_edges[e][1]]);
        keys[e] = 4 * low + high;
    }
    return keys;
}

}  // namespace

LengthOrder length_order(const IndexVector<VertexIndex, Point>& points, const CellVertices& cell) {
    std::array<Point, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = points[cell[k]];
    std::array<double, 6> lengths;
    for (std::size_t e = 0; e < 6; ++e) {
        lengths[e] = squared_length({corners[cell_edges[e][0]], corners[cell_edges[e][1]]});
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
        const std::array<unsigned, 6> keys = keys_of(corners);
        unsigned by_key = 0;
        pair = 0;
        for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t j = i + 1; j < 6; ++j, ++pair) {
                by_key |= static_cast<unsigned>(keys[i] > keys[j]) << pair;
            }
        }
        comparisons |= ties & by_key;
    }
    return PatternTable::get().order(static_cast<Comparisons>(comparisons));
}

}  // namespace octetra::distributed
