#include "pattern/triangle.hpp"

#include <octetra/core/edge_order.hpp>

namespace octetra::distributed {
namespace {

struct BisectedEdge {
    std::size_t low = 0;  // positions of its ends in the triangle
    std::size_t high = 0;
    VertexIndex midpoint;
    Segment segment;
};

void cut(BisectedTriangle& result, const FacetVertices& triangle, const BisectedEdge& edge) {
    for (std::size_t i = 0; i < result.piece_count; ++i) {
        const FacetVertices piece = result.pieces[i];
        if (piece[edge.low] != triangle[edge.low] || piece[edge.high] != triangle[edge.high]) {
            continue;
        }
        // The two halves replace the piece; later pieces are shifted.
        for (std::size_t j = result.piece_count; j > i + 1; --j) {
            result.pieces[j] = result.pieces[j - 1];
            result.halvings[j] = result.halvings[j - 1];
        }
        ++result.halvings[i];
        result.halvings[i + 1] = result.halvings[i];
        ++result.piece_count;
        result.pieces[i][edge.high] = edge.midpoint;
        result.pieces[i + 1] = piece;
        result.pieces[i + 1][edge.low] = edge.midpoint;
        result.inner_edges[result.inner_edge_count++] = {piece[3 - edge.low - edge.high],
                                                         edge.midpoint};
        return;  // at most one piece has a given original edge
    }
}

}  // namespace

BisectedTriangle bisect_triangle(const FacetVertices& triangle,
                                 const std::array<VertexIndex, 3>& midpoints,
                                 const IndexVector<VertexIndex, Point>& points) {
    std::array<BisectedEdge, 3> longest_first;
    std::size_t count = 0;
    for (std::size_t e = 0; e < 3; ++e) {
        const auto [i, j] = triangle_edges[e];
        const VertexIndex midpoint = midpoints[e];
        if (midpoint.is_none()) continue;
        const BisectedEdge edge{i, j, midpoint, {points[triangle[i]], points[triangle[j]]}};
        std::size_t place = count++;
        for (; place > 0 && longer(edge.segment, longest_first[place - 1].segment); --place) {
            longest_first[place] = longest_first[place - 1];
        }
        longest_first[place] = edge;
    }
    BisectedTriangle result;
    result.pieces[0] = triangle;
    for (std::size_t k = 0; k < count; ++k) cut(result, triangle, longest_first[k]);
    return result;
}

}  // namespace octetra::distributed
