#include "bisect.hpp"

namespace octetra::reference {

std::vector<BisectedEdge> bisected_edges(const Mesh& mesh, const EdgeTable& table,
                                         const EdgeToMidpoint& midpoints,
                                         const std::vector<VertexIndex>& vertices) {
    std::vector<BisectedEdge> edges;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        for (std::size_t j = i + 1; j < vertices.size(); ++j) {
            const VertexIndex midpoint = midpoints[find_edge(table, vertices[i], vertices[j])];
            if (!midpoint.is_none()) edges.push_back({{vertices[i], vertices[j]}, midpoint});
        }
    }
    std::ranges::sort(edges, [&](const BisectedEdge& e, const BisectedEdge& f) {
        return longer(segment(mesh, e.ends), segment(mesh, f.ends));
    });
    return edges;
}

}  // namespace octetra::reference
