#include "closure.hpp"

#include <algorithm>

#include "longest.hpp"

namespace octetra::reference {

EdgeSet close(EdgeSet selected, const Mesh& mesh, const EdgeTable& table) {
    const auto is_selected = [&](EdgeIndex e) { return selected[e] != 0; };
    bool changed = true;
    while (changed) {
        changed = false;
        for (const auto& cell : table.cell_to_edges) {
            for (std::size_t face = 0; face < 4; ++face) {
                const auto edges = face_edges(cell, face);
                if (std::ranges::none_of(edges, is_selected)) continue;
                const EdgeIndex longest_edge = longest(mesh, table, edges);
                if (is_selected(longest_edge)) continue;
                selected[longest_edge] = true;
                changed = true;
            }
        }
    }
    return selected;
}

}  // namespace octetra::reference
