#include <octetra/reference/history.hpp>

#include <octetra/core/standard_arithmetic.hpp>

#include "bisect.hpp"
#include "mark_edges.hpp"

namespace octetra::reference {

Refinement refine(const Mesh& mesh, const Selection& selection, Scheme scheme, int levels,
                  std::size_t max_cells) {
    const StandardArithmetic standard;
    Refinement result = unrefined(mesh);
    for (int level = 1; level <= levels; ++level) {
        const auto edges = edges_to_bisect(result.mesh, marked_cells(result, selection), scheme);
        result = bisect_mesh(result, edges, level, max_cells);
    }
    return result;
}

std::vector<Refinement> replay(const History& history, std::size_t max_cells) {
    const StandardArithmetic standard;
    std::vector<Refinement> meshes{unrefined(history.input)};
    for (const auto& edges : history.steps) {
        const auto level = static_cast<int>(meshes.size());
        meshes.push_back(bisect_mesh(meshes.back(), edges, level, max_cells));
    }
    return meshes;
}

History refined(const History& history, const CellMarks& marked, Scheme scheme) {
    const StandardArithmetic standard;
    const auto edges = edges_to_bisect(replay(history).back().mesh, marked, scheme);
    History longer = history;
    if (!edges.empty()) longer.steps.push_back(edges);
    return longer;
}

}  // namespace octetra::reference
