#include "request/regular_cells.hpp"

#include <algorithm>
#include <optional>

#include <octetra/core/edge_order.hpp>

#include "mesh/face_edges.hpp"

namespace octetra::verify {
namespace {

/// Returns the position in `vertices` of v, or 4.
std::size_t position_of(VertexIndex v, const CellVertices& vertices) {
    return static_cast<std::size_t>(std::ranges::find(vertices, v) - vertices.begin());
}

}  // namespace

RegularCells::RegularCells(const std::vector<DescendantCell>& roots,
                           const IndexVector<VertexIndex, Point>& points, Lines& lines)
    : points_(points), lines_(lines) {
    for (const DescendantCell& root : roots) append(root.vertices, root.root);
}

RegularCells::EdgeNumber RegularCells::number_of(const EdgeVertices& edge) {
    std::uint32_t& number = numbers_.at(edge[0], edge[1]);
    if (number == EdgeTable::absent) {
        number = static_cast<EdgeNumber>(edges_.size());
        const auto& [low, high] = std::minmax(edge[0], edge[1]);
        edges_.push_back({.ends = {low, high}});
    }
    return number;
}

void RegularCells::append(const CellVertices& vertices, CellIndex root) {
    const auto c = static_cast<CellNumber>(cells_.size());
    Cell cell{.vertices = vertices, .root = root};
    for (std::size_t k = 0; k < 6; ++k) {
        const auto [i, j] = cell_edges[k];
        cell.edges[k] = number_of({vertices[i], vertices[j]});
        cell.next_cell[k] = std::exchange(edges_[cell.edges[k]].first_cell, c);
    }
    cells_.push_back(cell);
}

void RegularCells::add(EdgeNumber e) {
    Edge& edge = edges_[e];
    if (edge.is_bisected) return;
    edge.is_bisected = true;
    edge.midpoint = lines_.midpoint(edge.ends[0], edge.ends[1]);
    if (edge.midpoint.is_none()) without_midpoint_.push_back(e);
    added_.push_back(edge.ends);
    examine_cells_with(e);
    if (edge.above != none) examine_cells_with(edge.above);
}

void RegularCells::add_edges_of(CellNumber c) {
    for (const EdgeNumber e : cells_[c].edges) add(e);
}

void RegularCells::examine(CellNumber c) {
    if (std::exchange(cells_[c].waits, true)) return;
    unexamined_.push_back(c);
}

void RegularCells::examine_cells_with(EdgeNumber e) {
    for (CellNumber c = edges_[e].first_cell; c != none;) {
        const Cell& cell = cells_[c];
        examine(c);
        c = cell.next_cell[static_cast<std::size_t>(std::ranges::find(cell.edges, e) -
                                                    cell.edges.begin())];
    }
}

void RegularCells::close() {
    while (!unexamined_.empty()) {
        const CellNumber c = unexamined_.back();
        unexamined_.pop_back();
        cells_[c].waits = false;
        if (cells_[c].first_child == none) apply_rules(c);
    }
}

void RegularCells::apply_rules(CellNumber c) {
    const std::array<EdgeNumber, 6> edges = cells_[c].edges;
    const auto is_in_set = [&](EdgeNumber e) { return edges_[e].is_bisected; };
    for (const auto& [i, j, k] : face_edges) {
        const std::array<EdgeNumber, 3> face{edges[i], edges[j], edges[k]};
        if (std::ranges::none_of(face, is_in_set)) continue;
        add(longest_of(face));                          // rule (2)
        if (has_bisected_piece(face)) add_edges_of(c);  // rule (3)
    }
    const auto has_midpoint = [&](EdgeNumber e) { return !edges_[e].midpoint.is_none(); };
    if (std::ranges::all_of(edges, has_midpoint)) create_children(c);
}

void RegularCells::create_children(CellNumber c) {
    const auto first = static_cast<CellNumber>(cells_.size());
    const Cell parent = cells_[c];  // a copy, because the list grows
    bisected_edges(c).for_each_piece(
        parent.vertices, [&](const CellVertices& child) { append(child, parent.root); });
    cells_[c].first_child = first;
    for (CellNumber child = first; child < cells_.size(); ++child) {
        link_to_parent(cells_[child], parent);
        examine(child);
    }
}

void RegularCells::link_to_parent(const Cell& child, const Cell& parent) {
    // The edge of the parent that each vertex of the child halves; nothing for a corner.
    std::array<std::optional<std::size_t>, 4> halved;
    for (std::size_t k = 0; k < 6; ++k) {
        const std::size_t at = position_of(edges_[parent.edges[k]].midpoint, child.vertices);
        if (at < 4) halved[at] = k;
    }
    for (std::size_t k = 0; k < 6; ++k) {
        const auto& a = halved[cell_edges[k][0]];
        const auto& b = halved[cell_edges[k][1]];
        EdgeNumber above = none;
        if (a && b) {
            if (*a + *b == 5) continue;  // opposite edges: it lies inside the parent
            above = parent.edges[*a];
            if (is_longer(parent.edges[*b], above)) above = parent.edges[*b];
        } else if (a || b) {
            above = parent.edges[a ? *a : *b];
        }
        Edge& edge = edges_[child.edges[k]];
        if (edge.above != none) continue;
        edge.above = above;
        if (edge.is_bisected && above != none) examine_cells_with(above);
    }
}

RegularCells::CellNumber RegularCells::child_of(CellNumber c, const CellVertices& vertices) const {
    const CellNumber first = cells_[c].first_child;
    for (CellNumber child = first; first != none && child < first + 8; ++child) {
        if (std::ranges::is_permutation(cells_[child].vertices, vertices)) return child;
    }
    return none;
}

bool RegularCells::is_longer(EdgeNumber e, EdgeNumber f) const {
    const auto& [a, b] = edges_[e].ends;
    const auto& [c, d] = edges_[f].ends;
    return longer({points_[a], points_[b]}, {points_[c], points_[d]});
}

RegularCells::EdgeNumber RegularCells::longest_of(const std::array<EdgeNumber, 3>& face) const {
    return *std::ranges::max_element(face,
                                     [&](EdgeNumber e, EdgeNumber f) { return is_longer(f, e); });
}

bool RegularCells::is_bisected(VertexIndex a, VertexIndex b) const {
    const std::uint32_t number = numbers_.find(a, b);
    return number != EdgeTable::absent && edges_[number].is_bisected;
}

/// Returns whether an edge of the four triangles into which the face is divided is in the set. Such
/// an edge is that of a regular cell, whose parent has the same face, or the edge of which it is a
/// half. So only pieces between midpoints of edges in the set need to be found.
bool RegularCells::has_bisected_piece(const std::array<EdgeNumber, 3>& face) const {
    for (const EdgeNumber e : face) {
        const Edge& edge = edges_[e];
        if (edge.midpoint.is_none()) continue;
        if (is_bisected(edge.ends[0], edge.midpoint)) return true;
        if (is_bisected(edge.midpoint, edge.ends[1])) return true;
    }
    const EdgeNumber longest = longest_of(face);
    const auto& [a, b] = edges_[longest].ends;
    const VertexIndex middle = edges_[longest].midpoint;
    if (middle.is_none()) return false;
    for (const EdgeNumber e : face) {
        if (e == longest) continue;
        if (!edges_[e].midpoint.is_none() && is_bisected(middle, edges_[e].midpoint)) return true;
        for (const VertexIndex v : edges_[e].ends) {
            if (v != a && v != b && is_bisected(middle, v)) return true;  // the opposite corner
        }
    }
    return false;
}

BisectedEdges RegularCells::bisected_edges(CellNumber c) const {
    BisectedEdges bisected(points_);
    for (const EdgeNumber e : cells_[c].edges) {
        if (edges_[e].is_bisected) bisected.add({edges_[e].ends, edges_[e].midpoint});
    }
    return bisected;
}

}  // namespace octetra::verify
