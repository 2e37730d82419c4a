#include "mark_edges.hpp"

#include "longest.hpp"

namespace octetra::reference {

EdgeSet mark_edges(const Mesh& mesh, const EdgeTable& table, const Selection& selection,
                   Scheme scheme, const IndexVector<CellIndex, CellIndex>& cell_to_parent) {
    EdgeSet marked(table.edges.size(), false);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.points[mesh.cells[c][k]];
        const Marker region = mesh.regions.empty() ? 0 : mesh.regions[c];
        if (!marks(selection, corners, region, GlobalCell{cell_to_parent[c].value()})) continue;

        const auto& edges = table.cell_to_edges[c];
        switch (scheme) {
            case Scheme::eight:
                for (const EdgeIndex e : edges) marked[e] = true;
                break;
            case Scheme::four:
                for (std::size_t face = 0; face < 4; ++face) {
                    marked[longest(mesh, table, face_edges(edges, face))] = true;
                }
                break;
            case Scheme::two: marked[longest(mesh, table, edges)] = true; break;
        }
    }
    return marked;
}

}  // namespace octetra::reference
