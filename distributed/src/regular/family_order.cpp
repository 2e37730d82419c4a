#include "regular/family_order.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "history/families.hpp"
#include "level/level.hpp"
#include "pattern/length_order.hpp"

namespace octetra::distributed {
namespace {

using Family = TransitionCells::Family;
using Kind = TransitionCells::Kind;

void put_in_order(DistributedMesh& mesh, Descent& descent, const TransitionCells& cells,
                  Family pieces, std::uint32_t generation) {
    const DividedCell divided(mesh, cells, pieces, generation);
    const LengthOrder order = length_order(mesh.points, divided.corners());
    const Pattern& pattern = PatternTable::get().pattern(order, divided.edges);
    assert(pattern.child_count == pieces.end.value() - pieces.begin.value());
    std::array<std::uint32_t, 8> before{};
    std::array<std::uint8_t, 8> halvings{};
    std::array<CellVertices, 8> children;
    for (std::size_t k = 0; k < pattern.child_count; ++k) {
        children[k] = child_of(divided.vertices, pattern.children[k]);
        CellIndex piece = pieces.begin;
        while (!std::ranges::is_permutation(mesh.cells[piece], children[k])) ++piece;
        before[k] = descent.before[piece.value()];
        halvings[k] = descent.halvings[piece.value()];
    }
    const auto begin = static_cast<std::ptrdiff_t>(pieces.begin.value());
    std::copy_n(children.begin(), pattern.child_count, mesh.cells.begin() + begin);
    std::copy_n(before.begin(), pattern.child_count, descent.before.begin() + begin);
    std::copy_n(halvings.begin(), pattern.child_count, descent.halvings.begin() + begin);
}

}  // namespace

DividedCell::DividedCell(const DistributedMesh& mesh, const TransitionCells& cells,
                         TransitionCells::Family pieces, std::uint32_t generation) {
    CellVertices corners;
    std::vector<VertexIndex> midpoints;
    for (CellIndex c = pieces.begin; c < pieces.end; ++c) {
        for (std::size_t k = 0; k < 4; ++k) {
            const VertexIndex v = mesh.cells[c][k];
            if (cells.generation_of(v) > generation) {
                midpoints.push_back(v);
            } else {
                corners[k] = v;  // a corner keeps its position in every piece
            }
        }
    }
    std::ranges::copy(corners, vertices.begin());
    for (const VertexIndex v : midpoints) {
        const std::size_t edge =
            edge_between(corners, mesh.midpoint_to_edge[v.value() - mesh.input_vertices.size()]);
        vertices[4 + edge] = v;
        edges = static_cast<EdgeMask>(edges | 1U << edge);
    }
}

TransitionCells::Kinds order_families(DistributedMesh& mesh, Descent& cells,
                                      const TransitionCells& before, const BisectedCells& level) {
    TransitionCells::Kinds kinds;
    kinds.assign(mesh.cells.size(), Kind::regular);
    const CellIndex end{level.marked.size()};
    for (CellIndex c{0}; c < end;) {
        const bool is_transition = before.contains(c);
        const Family family =
            is_transition ? before.family_of(c) : Family{c, CellIndex{c.value() + std::size_t{1}}};
        const Family pieces{CellIndex{level.first[family.begin.value()]},
                            CellIndex{level.first[family.end.value()]}};
        bool is_marked = false;
        for (; c < family.end; ++c) is_marked = is_marked || level.marked[c.value()] != 0;
        if (is_transition && is_marked) {
            put_in_order(mesh, cells, before, pieces, level.generation);
        }
        const std::size_t count = pieces.end.value() - pieces.begin.value();
        if (count == 8 || (!is_transition && !is_marked)) continue;
        for (CellIndex piece = pieces.begin; piece < pieces.end; ++piece) {
            kinds[piece] = piece == pieces.begin ? Kind::first_sibling : Kind::further_sibling;
        }
    }
    return kinds;
}

}  // namespace octetra::distributed
