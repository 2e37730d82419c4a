#include "regular/family_order.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "history/families.hpp"
#include "level/incremental/adjacency.hpp"
#include "level/level.hpp"
#include "pattern/length_order.hpp"

namespace octetra::distributed {

DividedCell::DividedCell(const DistributedMesh& mesh, const TransitionCells& cells,
                         const CellRun& pieces, std::uint32_t generation) {
    const auto is_midpoint = [&](VertexIndex v) { return cells.generation_of(v) > generation; };
    CellVertices corners;
    for (const CellIndex c : pieces) {
        for (std::size_t k = 0; k < 4; ++k) {
            const VertexIndex v = mesh.cells[c][k];
            if (!is_midpoint(v)) corners[k] = v;  // a corner keeps its position in every piece
        }
    }
    std::ranges::copy(corners, vertices.begin());
    for (const CellIndex c : pieces) {
        for (const VertexIndex v : mesh.cells[c]) {
            if (!is_midpoint(v)) continue;
            const EdgeVertices& ends =
                mesh.midpoint_to_edge[v.value() - mesh.input_vertices.size()];
            const std::size_t edge = edge_between(corners, ends);
            vertices[4 + edge] = v;
            edges = static_cast<EdgeMask>(edges | 1U << edge);
        }
    }
}

void FamilyOrder::restore(const TransitionCells& cells, const CellRun& pieces,
                          std::uint32_t generation, Descent& descent) {
    const DividedCell divided(*mesh_, cells, pieces, generation);
    const LengthOrder order = length_order(mesh_->points, divided.corners());
    const Pattern& pattern = PatternTable::get().pattern(order, divided.edges);
    assert(pattern.child_count == pieces.size());
    std::array<std::uint32_t, 8> before{};
    std::array<std::uint8_t, 8> halvings{};
    std::array<CellVertices, 8> children;
    for (std::size_t k = 0; k < pattern.child_count; ++k) {
        children[k] = child_of(divided.vertices, pattern.children[k]);
        const CellIndex piece = *std::ranges::find_if(pieces, [&](CellIndex c) {
            return std::ranges::is_permutation(mesh_->cells[c], children[k]);
        });
        before[k] = descent.before[piece.value()];
        halvings[k] = descent.halvings[piece.value()];
    }
    for (std::size_t k = 0; k < pattern.child_count; ++k) {
        replace(pieces[k], children[k]);
        descent.before[pieces[k].value()] = before[k];
        descent.halvings[pieces[k].value()] = halvings[k];
    }
}

void FamilyOrder::replace(CellIndex cell, const CellVertices& vertices) {
    Adjacency* const unordered = mesh_->adjacency.get();
    if (unordered == nullptr) {  // the level before restores the whole list
        mesh_->cells[cell] = vertices;
        return;
    }
    before_.emplace_back(cell, mesh_->cells[cell]);
    unordered->cells.change(cell, vertices, mesh_->cells);
    unordered->blocks.add_replaced(*mesh_, cell);
}

FamilyOrder::~FamilyOrder() {
    if (before_.empty()) return;
    mesh_->adjacency->drop_index();
    for (std::size_t k = before_.size(); k-- > 0;) {
        mesh_->cells[before_[k].first] = before_[k].second;
    }
}

}  // namespace octetra::distributed
