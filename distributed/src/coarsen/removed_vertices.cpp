#include "coarsen/removed_vertices.hpp"

#include <algorithm>
#include <cstdint>

#include <octetra/core/selection.hpp>

namespace octetra::distributed {

std::vector<RemovedVertex> removed_vertices(const DistributedMesh& mesh, const KeptVertices& kept,
                                            const CoarserPart& part, bool in_place) {
    std::vector<RemovedVertex> removed;
    const std::size_t input_count = mesh.input_vertices.size();
    const std::size_t first = part.first_removed.value();
    std::vector<std::uint32_t> position(mesh.points.size() - std::min(first, mesh.points.size()));
    for (VertexIndex v = part.first_removed; v < mesh.points.end_index(); ++v) {
        if (kept[v] != 0) continue;
        // Both ends remain: a cell at an end that is removed as well would have been bisected
        // since.
        const auto& [low, high] = mesh.midpoint_to_edge[v.value() - input_count];
        position[v.value() - first] = static_cast<std::uint32_t>(removed.size());
        removed.push_back({v, {part.vertex_after[low], part.vertex_after[high]}, 0});
    }
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        if (in_place && part.cells.halvings()[c.value()] == 0) continue;  // not merged
        const CellVertices& cell = mesh.cells[c];
        if (std::ranges::all_of(cell, [&](VertexIndex v) { return kept[v] != 0; })) continue;
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.points[cell[k]];
        const double share = volume(corners) / 4;
        for (const VertexIndex v : cell) {
            if (kept[v] != 0) continue;
            removed[position[v.value() - first]].volume += share;
        }
    }
    return removed;
}

}  // namespace octetra::distributed
