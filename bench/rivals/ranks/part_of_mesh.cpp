#include "rivals/ranks/part_of_mesh.hpp"

#include <cstddef>

namespace octetra::rivals {

PartOfMesh part_of(const Mesh& whole, const std::vector<int>& part_of_cell, int part) {
    IndexVector<VertexIndex, char> has_cell(whole.points.size(), 0);
    IndexVector<VertexIndex, char> is_here(whole.points.size(), 0);
    for (CellIndex c{0}; c < whole.cells.end_index(); ++c) {
        for (const VertexIndex v : whole.cells[c]) {
            has_cell[v] = 1;
            if (part_of_cell[c.value()] == part) is_here[v] = 1;
        }
    }
    PartOfMesh made;
    made.mesh.index_base = whole.index_base;
    IndexVector<VertexIndex, VertexIndex> here(whole.points.size());
    for (VertexIndex v{0}; v < whole.points.end_index(); ++v) {
        if (is_here[v] == 0 && (part != 0 || has_cell[v] != 0)) continue;
        here[v] = made.mesh.points.append(whole.points[v]);
        made.vertex_numbers.push_back(v.value());
    }
    for (CellIndex c{0}; c < whole.cells.end_index(); ++c) {
        if (part_of_cell[c.value()] != part) continue;
        const auto& [p, q, r, s] = whole.cells[c];
        made.mesh.cells.push_back({here[p], here[q], here[r], here[s]});
        made.roots.push_back(c.value());
        if (!whole.regions.empty()) made.mesh.regions.push_back(whole.regions[c]);
    }
    return made;
}

}  // namespace octetra::rivals
