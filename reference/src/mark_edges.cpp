#include "mark_edges.hpp"

#include <algorithm>

#include <octetra/core/cell_quantities.hpp>
#include <octetra/core/check_selection.hpp>
#include <octetra/core/select_cells.hpp>
#include <octetra/core/standard_arithmetic.hpp>

#include "closure.hpp"

namespace octetra::reference {

CellMarks marked_cells(const Refinement& refined, const Selection& selection) {
    const StandardArithmetic standard;
    check(selection);
    const Mesh& mesh = refined.mesh;
    const SelectedCells selected = select_cells(
        selection, mesh.cells.size(),
        [&](std::size_t number) {
            const CellIndex c{number};
            CellToTest cell;
            for (std::size_t k = 0; k < 4; ++k) cell.corners[k] = mesh.points[mesh.cells[c][k]];
            cell.region = mesh.regions.empty() ? 0 : mesh.regions[c];
            cell.root = GlobalCell{refined.maps.cell_to_parent[c].value()};
            return cell;
        },
        term_values(selection, mesh, refined.maps));
    if (!selected.undefined.empty()) {
        const auto& [cell, expression] = std::ranges::min(selected.undefined);
        refuse_undefined(selection, expression, mesh.index_base + cell);
    }
    return {selected.marks.begin(), selected.marks.end()};
}

EdgeSet mark_edges(const Mesh& mesh, const EdgeTable& table, const CellMarks& marks,
                   Scheme scheme) {
    EdgeSet marked(table.edges.size(), false);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        if (marks[c] == 0) continue;
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

std::vector<EdgeVertices> edges_to_bisect(const Mesh& mesh, const CellMarks& marks, Scheme scheme) {
    const EdgeTable table = number_edges(mesh);
    const EdgeSet closed = close(mark_edges(mesh, table, marks, scheme), mesh, table);
    std::vector<EdgeVertices> edges;
    for (EdgeIndex e{0}; e < table.edges.end_index(); ++e) {
        if (closed[e] != 0) edges.push_back(table.edges[e]);
    }
    return edges;
}

}  // namespace octetra::reference
