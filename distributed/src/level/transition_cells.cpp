#include "level/transition_cells.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>

#include <octetra/core/edge_order.hpp>

#include "level/incremental/adjacency.hpp"

namespace octetra::distributed {
namespace {

/// Returns the edges of a cell of which both ends fulfil the condition.
EdgeMask edges_between(const CellVertices& cell, auto&& fulfils) {
    unsigned edges = 0;
    for (std::size_t e = 0; e < 6; ++e) {
        const auto& [i, j] = cell_edges[e];
        if (fulfils(cell[i]) && fulfils(cell[j])) edges |= 1U << e;
    }
    return static_cast<EdgeMask>(edges);
}

/// Returns the longest edge of a nonempty set.
EdgeMask longest_of(EdgeMask edges, const CellVertices& cell,
                    const IndexVector<VertexIndex, Point>& points) {
    const auto segment = [&](std::size_t e) {
        return Segment{points[cell[cell_edges[e][0]]], points[cell[cell_edges[e][1]]]};
    };
    std::size_t longest = 6;
    for (std::size_t e = 0; e < 6; ++e) {
        if ((unsigned{edges} >> e & 1U) == 0) continue;
        if (longest == 6 || longer(segment(e), segment(longest))) longest = e;
    }
    return static_cast<EdgeMask>(1U << longest);
}

}  // namespace

std::uint32_t TransitionCells::generation_of(CellIndex cell) const {
    std::uint32_t generation = 0;
    for (const VertexIndex v : mesh_->cells[cell])
        generation = std::max(generation, generations_[v]);
    return generation;
}

CellRun TransitionCells::family_of(CellIndex cell) const {
    const Adjacency* const unordered = mesh_->adjacency.get();
    while (kinds_[cell] == Kind::further_sibling) {
        cell = unordered != nullptr ? unordered->cells.previous(cell)
                                    : CellIndex{cell.value() - std::size_t{1}};
    }
    CellRun family;
    do {
        family.append(cell);
        cell = next_cell(*mesh_, cell);
    } while (!cell.is_none() && kinds_[cell] == Kind::further_sibling);
    return family;
}

// The new vertices of a transition cell are midpoints of edges of its parent, and its other
// vertices are corners of the parent, which are older.
EdgeMask TransitionCells::edges_of_parent(CellIndex cell) const {
    const CellVertices& vertices = mesh_->cells[cell];
    const std::uint32_t newest = generation_of(cell);
    return edges_between(vertices, [&](VertexIndex v) { return generations_[v] < newest; });
}

EdgeMask TransitionCells::edges_of_generation(CellIndex cell, std::uint32_t generation) const {
    const std::uint32_t own = generation_of(cell);
    if (!contains(cell)) return generation == own ? all_edges : 0;
    if (generation + 1 == own) return edges_of_parent(cell);
    return generation == own ? static_cast<EdgeMask>(all_edges & ~edges_of_parent(cell)) : 0;
}

EdgeMask TransitionCells::closure(CellIndex cell, EdgeMask marked) const {
    const EdgeMask edges = edges_of_parent(cell);
    const bool has_face = std::popcount(edges) == 3;  // of three corners of the parent
    if (!has_face || (edges & marked) == 0) return marked;
    return static_cast<EdgeMask>(marked | longest_of(edges, mesh_->cells[cell], mesh_->points));
}

void TransitionCells::set_run(const CellRun& run) {
    const bool is_regular = run.size() == 8;
    for (const CellIndex c : run) {
        const Kind of_family = c == run[0] ? Kind::first_sibling : Kind::further_sibling;
        kinds_[c] = is_regular ? Kind::regular : of_family;
    }
}

void TransitionCells::add_midpoints(std::uint32_t generation) {
    generations_.resize(mesh_->points.size(), generation + 1);
}

}  // namespace octetra::distributed
