#include <algorithm>

#include "properties/laws.hpp"
#include "properties/one_level.hpp"
#include "properties/team.hpp"

namespace octetra::properties {
namespace {

struct Counts {
    std::size_t vertices = 0;
    std::size_t edges = 0;
    std::size_t faces = 0;
    std::size_t boundary_faces = 0;
    std::size_t cells = 0;

    friend bool operator==(const Counts&, const Counts&) = default;
    [[nodiscard]] std::size_t euler() const { return vertices + faces - edges - cells; }
};

Counts counts_of(const Mesh& mesh) {
    Edges edges;
    std::set<FacetVertices> faces;
    for (const CellVertices& cell : mesh.cells) {
        for (const EdgeVertices& e : edges_of(cell)) edges.insert(e);
        for (const auto& [i, j, k] : cell_faces) {
            FacetVertices face{cell[i], cell[j], cell[k]};
            std::ranges::sort(face);
            faces.insert(face);
        }
    }
    // each inner face counts twice, each boundary face once
    return {mesh.points.size(), edges.size(), faces.size(),
            2 * faces.size() - 4 * mesh.cells.size(), mesh.cells.size()};
}

/// Each edge is halved, each face is cut into four, each cell into eight.
Counts after_uniform_level(const Counts& n) {
    return {n.vertices + n.edges, 2 * n.edges + 3 * n.faces + n.cells, 4 * n.faces + 8 * n.cells,
            4 * n.boundary_faces, 8 * n.cells};
}

std::size_t opposite(std::size_t edge) { return 5 - edge; }  // 01-23, 02-13, 03-12

/// The number of children of a cell, given the bisected edges.
std::size_t children_of(const Mesh& mesh, const CellVertices& cell, const Edges& bisected) {
    const auto edges = edges_of(cell);
    std::size_t count = 1;
    for (const EdgeVertices& e : edges) count += bisected.contains(e) ? 1U : 0U;
    const EdgeVertices top = longest(mesh, {edges.begin(), edges.end()});
    const auto at = static_cast<std::size_t>(std::ranges::find(edges, top) - edges.begin());
    if (bisected.contains(top) && bisected.contains(edges[opposite(at)])) ++count;
    return count;
}

std::string fault_of_one_level(const Case& c, const Outcome& outcome) {
    const Edges bisected(outcome.maps.midpoint_to_edge.begin(),
                         outcome.maps.midpoint_to_edge.end());
    std::vector<std::size_t> children(c.mesh.cells.size());
    for (const CellIndex parent : outcome.maps.cell_to_parent) ++children[parent.value()];
    for (CellIndex i{0}; i < c.mesh.cells.end_index(); ++i) {
        const std::size_t expected = children_of(c.mesh, c.mesh.cells[i], bisected);
        if (children[i.value()] != expected) return "a cell has a wrong number of children";
        if (is_marked(c, i) && !std::ranges::includes(bisected, marked_by(c, i))) {
            return "a marked cell is not bisected as the scheme requires";
        }
    }
    if (outcome.mesh.points.size() != c.mesh.points.size() + bisected.size()) {
        return "there are not as many new vertices as bisected edges";
    }
    return {};
}

}  // namespace

std::string fault_of_counts(const Case& c) {
    const Outcome outcome = refined_by_all(c);
    if (!outcome.error.empty()) return {};
    const Counts before = counts_of(c.mesh);
    const Counts after = counts_of(outcome.mesh);
    if (after.euler() != before.euler()) return "the Euler characteristic is not the same";
    if (c.selection.all && c.scheme == Scheme::eight) {
        Counts expected = before;
        for (int level = 0; level < c.levels; ++level) expected = after_uniform_level(expected);
        if (after != expected) return "counts are not those of uniform levels";
    }
    Case one_level = c;
    one_level.levels = 1;
    return fault_of_one_level(one_level, c.levels == 1 ? outcome : refined_by_all(one_level));
}

}  // namespace octetra::properties
