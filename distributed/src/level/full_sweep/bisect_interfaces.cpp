#include "level/full_sweep/bisect_interfaces.hpp"

#include <algorithm>
#include <iterator>

#include "level/full_sweep/bisect_edges.hpp"
#include "pattern/triangle.hpp"

namespace octetra::distributed {

void bisect_interfaces(std::vector<Interface>& interfaces,
                       const IndexVector<VertexIndex, Point>& points,
                       const EdgeNumbering& numbering,
                       const IndexVector<EdgeIndex, VertexIndex>& midpoints) {
    for (auto& [rank, edges, faces] : interfaces) {
        const std::size_t edge_count = edges.size();
        for (std::size_t k = 0; k < edge_count; ++k) {
            const auto [a, b] = edges[k];
            const VertexIndex midpoint = midpoints[numbering.find(a, b)];
            if (midpoint.is_none()) continue;
            edges[k] = {a, midpoint};
            edges.push_back({midpoint, b});
        }
        const std::size_t face_count = faces.size();
        for (std::size_t k = 0; k < face_count; ++k) {
            const BisectedTriangle bisected =
                bisect_triangle(faces[k], midpoints_of(faces[k], numbering, midpoints), points);
            faces[k] = bisected.pieces[0];
            std::copy_n(bisected.pieces.begin() + 1, bisected.piece_count - 1,
                        std::back_inserter(faces));
            std::copy_n(bisected.inner_edges.begin(), bisected.inner_edge_count,
                        std::back_inserter(edges));
        }
    }
}

}  // namespace octetra::distributed
