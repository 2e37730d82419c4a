#include "edges.hpp"

namespace octetra::reference {

EdgeTable number_edges(const Mesh& mesh) {
    EdgeTable table;
    for (const CellVertices& cell : mesh.cells) {
        for (const auto& [i, j] : cell_edges) {
            const auto& [low, high] = std::minmax(cell[i], cell[j]);
            table.edges.append({low, high});
        }
    }
    std::ranges::sort(table.edges);
    table.edges.erase(std::unique(table.edges.begin(), table.edges.end()), table.edges.end());

    for (const CellVertices& cell : mesh.cells) {
        std::array<EdgeIndex, 6> numbers;
        std::ranges::transform(cell_edges, numbers.begin(), [&](const auto& ends) {
            return find_edge(table, cell[ends[0]], cell[ends[1]]);
        });
        table.cell_to_edges.append(numbers);
    }
    return table;
}

EdgeIndex find_edge(const EdgeTable& table, VertexIndex a, VertexIndex b) {
    const auto& [low, high] = std::minmax(a, b);
    const auto place = std::ranges::lower_bound(table.edges, EdgeVertices{low, high});
    return EdgeIndex{static_cast<std::size_t>(place - table.edges.begin())};
}

}  // namespace octetra::reference
