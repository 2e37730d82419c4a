#include <octetra/reference/history.hpp>

#include "bisect.hpp"
#include "mark_edges.hpp"

namespace octetra::reference {

std::vector<Refinement> replay(const History& history) {
    std::vector<Refinement> meshes{unrefined(history.input)};
    for (const auto& edges : history.steps) {
        const int level = static_cast<int>(meshes.size());
        meshes.push_back(bisect_mesh(meshes.back(), edges, level));
    }
    return meshes;
}

History refined(const History& history, const CellMarks& marked, Scheme scheme) {
    const auto edges = edges_to_bisect(replay(history).back().mesh, marked, scheme);
    History longer = history;
    if (!edges.empty()) longer.steps.push_back(edges);
    return longer;
}

}  // namespace octetra::reference
