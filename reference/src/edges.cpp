#include "edges.hpp"

#include <algorithm>

namespace octetra::reference {
namespace {

EdgeVertices ascending(VertexIndex a, VertexIndex b) {
    return a < b ? EdgeVertices{a, b} : EdgeVertices{b, a};
}

}  // namespace

EdgeTable number_edges(const Mesh& mesh) {
    EdgeTable table;
    for (const CellVertices& cell : mesh.cells) {
        for (const auto& [i, j] : cell_edges) table.edges.append(ascending(cell[i], cell[j]));
    }
    std::ranges::sort(table.edges);
    table.edges.erase(std::unique(table.edges.begin(), table.edges.end()), table.edges.end());

    for (const CellVertices& cell : mesh.cells) {
        std::array<EdgeIndex, 6> numbers;
        for (std::size_t k = 0; k < 6; ++k) {
            const auto& [i, j] = cell_edges[k];
            numbers[k] = find_edge(table, cell[i], cell[j]);
        }
        table.cell_to_edges.append(numbers);
    }
    return table;
}

EdgeIndex find_edge(const EdgeTable& table, VertexIndex a, VertexIndex b) {
    const auto place = std::ranges::lower_bound(table.edges, ascending(a, b));
    return EdgeIndex{static_cast<std::size_t>(place - table.edges.begin())};
}

}  // namespace octetra::reference
