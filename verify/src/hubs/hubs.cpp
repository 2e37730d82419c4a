#include "hubs/hubs.hpp"

#include <algorithm>

namespace octetra::verify {

Hubs::Hubs(const JudgedMesh& judged)
    : many_(judged.many), degree_(judged.mesh.points.size(), 0), cells_around_(16) {
    judged.edges.for_each([&](const EdgeVertices& edge) {
        for (const VertexIndex v : edge) ++degree_[v.value()];
    });
    hubs_ = static_cast<std::size_t>(std::count_if(degree_.begin(), degree_.end(),
                                                   [this](std::uint32_t n) { return n > many_; }));
    if (hubs_ < 2) return;
    for (CellIndex c{0}; c < judged.mesh.cells.end_index(); ++c) {
        if (!judged.is_sound(c)) continue;
        const CellVertices& cell = judged.mesh.cells[c];
        for (const auto& [i, k] : cell_edges) {
            if (!is_hub(cell[i]) || !is_hub(cell[k])) continue;
            std::uint32_t& cells = cells_around_.at(cell[i], cell[k]);
            cells = cells == EdgeTable::absent ? 1 : cells + 1;
        }
    }
}

}  // namespace octetra::verify
