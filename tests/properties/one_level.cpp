#include "properties/one_level.hpp"

#include <algorithm>

#include <octetra/core/edge_order.hpp>

#include "support/refinement.hpp"

namespace octetra::properties {
namespace {

std::vector<EdgeVertices> edges_of_face(const CellVertices& cell, std::size_t face) {
    const auto& [i, j, k] = cell_faces[face];
    return {edge_between(cell[i], cell[j]), edge_between(cell[i], cell[k]),
            edge_between(cell[j], cell[k])};
}

}  // namespace

EdgeVertices edge_between(VertexIndex a, VertexIndex b) { return {std::min(a, b), std::max(a, b)}; }

std::array<EdgeVertices, 6> edges_of(const CellVertices& cell) {
    std::array<EdgeVertices, 6> edges;
    for (std::size_t e = 0; e < 6; ++e) {
        const auto& [i, j] = cell_edges[e];
        edges[e] = edge_between(cell[i], cell[j]);
    }
    return edges;
}

EdgeVertices longest(const Mesh& mesh, const std::vector<EdgeVertices>& edges) {
    const auto shorter = [&](const EdgeVertices& e, const EdgeVertices& f) {
        return longer({mesh.points[f[0]], mesh.points[f[1]]},
                      {mesh.points[e[0]], mesh.points[e[1]]});
    };
    return *std::ranges::max_element(edges, shorter);
}

std::array<EdgeVertices, 4> longest_of_faces(const Mesh& mesh, const CellVertices& cell) {
    std::array<EdgeVertices, 4> result;
    for (std::size_t f = 0; f < 4; ++f) result[f] = longest(mesh, edges_of_face(cell, f));
    return result;
}

bool is_marked(const Case& c, CellIndex cell) {
    const Marker region = c.mesh.regions.empty() ? 0 : c.mesh.regions[cell];
    return marks(c.selection, test::corners_of(c.mesh, cell), region, GlobalCell{cell.value()});
}

Edges marked_by(const Case& c, CellIndex cell) {
    const CellVertices& vertices = c.mesh.cells[cell];
    const auto all = edges_of(vertices);
    if (c.scheme == Scheme::eight) return {all.begin(), all.end()};
    const auto of_faces = longest_of_faces(c.mesh, vertices);
    if (c.scheme == Scheme::four) return {of_faces.begin(), of_faces.end()};
    return {longest(c.mesh, {all.begin(), all.end()})};
}

Edges closure_of(const Mesh& mesh, Edges edges) {
    std::size_t before = 0;
    do {
        before = edges.size();
        for (const CellVertices& cell : mesh.cells) {
            const auto longest_edges = longest_of_faces(mesh, cell);
            for (std::size_t f = 0; f < 4; ++f) {
                for (const EdgeVertices& e : edges_of_face(cell, f)) {
                    if (edges.contains(e)) edges.insert(longest_edges[f]);
                }
            }
        }
    } while (edges.size() > before);
    return edges;
}

}  // namespace octetra::properties
