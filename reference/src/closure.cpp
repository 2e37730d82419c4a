#include "closure.hpp"

#include <algorithm>

namespace octetra::reference {

EdgeSet close(EdgeSet marked, const Mesh& mesh, const EdgeTable& table) {
    const auto is_marked = [&](EdgeIndex e) { return marked[e] != 0; };
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& cell : table.cell_to_edges) {
            for (std::size_t face = 0; face < 4; ++face) {
                const auto edges = face_edges(cell, face);
                if (std::ranges::none_of(edges, is_marked)) continue;
                const EdgeIndex longest_edge = longest(mesh, table, edges);
                if (is_marked(longest_edge)) continue;
                marked[longest_edge] = true;
                changed = true;
            }
        }
    }
    return marked;
}

}  // namespace octetra::reference
