#include "rivals/cell_graph.hpp"

#include <algorithm>
#include <utility>

#include "rivals/face_neighbours.hpp"
#include "rivals/longest_edge.hpp"

namespace octetra::rivals {
namespace {

template <class T, std::size_t N>
std::uint8_t position(const std::array<T, N>& list, T wanted) {
    return static_cast<std::uint8_t>(std::ranges::find(list, wanted) - list.begin());
}

/// The half that keeps the vertex `kept` of these two.
CellIndex half(const StarCell& at, CellIndex second, std::uint8_t kept) {
    return kept == std::min(at.a, at.b) ? at.cell : second;
}

}  // namespace

CellGraph::CellGraph(const Mesh& mesh) : points(mesh.points) {
    const auto neighbours = face_neighbours(mesh);
    cells.resize(mesh.cells.size());
    next.resize(mesh.cells.size());
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        cells[c].vertices = mesh.cells[c];
        cells[c].neighbours = neighbours[c];
        cells[c].root = c;
        cells[c].longest = longest_edge(corners(c));
        next[c] = CellIndex{c.value() + std::size_t{1}};
    }
    if (!next.empty()) next.back() = CellIndex::none();
    find_several_rows();
}

/// Rows end at the boundary, so an edge with more than two boundary faces has several rows.
void CellGraph::find_several_rows() {
    std::vector<std::pair<std::uint64_t, CellIndex>> edges;
    for (CellIndex c{0}; c < cells.end_index(); ++c) {
        for (std::size_t face = 0; face < 4; ++face) {
            if (!cells[c].neighbours[face].is_none()) continue;
            for (const auto& [i, j] : cell_edges) {
                if (i == face || j == face) continue;
                edges.emplace_back(edge_key({cells[c].vertices[i], cells[c].vertices[j]}), c);
            }
        }
    }
    std::ranges::sort(edges);
    for (std::size_t i = 2; i < edges.size(); ++i) {
        const auto key = edges[i].first;
        if (key != edges[i - 2].first) continue;
        const EdgeVertices edge{VertexIndex{key >> 32U}, VertexIndex{key & 0xffffffffU}};
        for (const std::size_t k : {i - 2, i - 1, i}) add_row(edge, edges[k].second);
    }
}

void CellGraph::add_row(const EdgeVertices& edge, CellIndex c) {
    auto& known = rows[edge_key(edge)];
    Star star;
    append_row(place(c, edge), star);
    for (const StarCell& at : star.cells) {
        if (std::ranges::find(known, at.cell) != known.end()) return;
    }
    known.push_back(c);
}

StarCell CellGraph::place(CellIndex c, const EdgeVertices& edge) const {
    const std::uint8_t a = position(cells[c].vertices, edge[0]);
    const std::uint8_t b = position(cells[c].vertices, edge[1]);
    std::uint8_t other = 0;
    while (other == a || other == b) ++other;
    return {c, a, b, other, static_cast<std::uint8_t>(6 - a - b - other)};
}

void CellGraph::find_star(CellIndex c, Star& star) const {
    const auto& [a, b] = cell_edges[cells[c].longest];
    const auto& [i, j] = cell_edges[5U - cells[c].longest];  // the opposite edge
    star.cells.clear();
    append_row({c, a, b, i, j}, star);
    if (!rows.empty()) append_other_rows(star);
}

void CellGraph::find_star(const EdgeVertices& edge, Star& star) const {
    star.cells.clear();
    append_row(place(rows.at(edge_key(edge)).front(), edge), star);
    append_other_rows(star);
}

void CellGraph::append_other_rows(Star& star) const {
    const EdgeVertices edge = edge_of(star.cells.front());
    const auto found = rows.find(edge_key(edge));
    if (found == rows.end() || found->second.size() == 1) return;
    const std::size_t count = star.cells.size();
    for (const CellIndex c : found->second) {
        const auto is_there = [&](const StarCell& at) { return at.cell == c; };
        if (std::any_of(star.cells.data(), star.cells.data() + count, is_there)) continue;
        append_row(place(c, edge), star);
    }
}

void CellGraph::append_row(const StarCell& first, Star& star) const {
    const std::size_t begin = star.cells.size();
    star.cells.push_back(first);
    walk(star);
    if (star.is_ring) return;
    StarCell last = star.cells.back();
    std::swap(last.next, last.previous);
    last.joins_previous = false;
    star.cells.resize(begin);
    star.cells.push_back(last);
    walk(star);
}

/// Extends a star from its last cell to the end of the row, or around the edge.
void CellGraph::walk(Star& star) const {
    const StarCell first = star.cells.back();
    const auto [a, b] = edge_of(first);
    for (StarCell at = first;;) {
        const CellIndex beside = cells[at.cell].neighbours[at.next];
        star.is_ring = beside == first.cell;
        if (beside.is_none() || star.is_ring) return;
        const LinkedCell& cell = cells[beside];
        const std::uint8_t pa = position(cell.vertices, a);
        const std::uint8_t pb = position(cell.vertices, b);
        const std::uint8_t previous = position(cell.neighbours, at.cell);
        at = {beside, pa, pb, static_cast<std::uint8_t>(6 - pa - pb - previous), previous, true};
        star.cells.push_back(at);
    }
}

void CellGraph::bisect(const Star& star, VertexIndex midpoint) {
    const std::size_t first_new = cells.size();
    const std::size_t count = star.cells.size();
    const auto second = [&](std::size_t i) { return CellIndex{first_new + i}; };
    const EdgeVertices edge = edge_of(star.cells.front());
    for (const StarCell& at : star.cells) halve(at, midpoint);
    for (std::size_t i = 0; i < count; ++i) {
        if (!star.cells[i].joins_previous && !star.is_ring) continue;
        const std::size_t j = (i + count - 1) % count;
        join_halves(star.cells[i], second(i), star.cells[i].previous, star.cells[j], second(j));
        join_halves(star.cells[j], second(j), star.cells[j].next, star.cells[i], second(i));
    }
    if (!rows.empty()) halve_rows(star, edge, midpoint);
}

/// Rows that were found by the ends of the edge are kept for its halves.
void CellGraph::halve_rows(const Star& star, const EdgeVertices& edge, VertexIndex midpoint) {
    const std::size_t first_new = cells.size() - star.cells.size();
    for (std::size_t i = 0; i < star.cells.size(); ++i) {
        const StarCell& at = star.cells[i];
        const CellIndex second{first_new + i};
        const VertexIndex kept = cells[second].vertices[std::max(at.a, at.b)];
        for (const std::uint8_t beside : {at.next, at.previous}) {
            put_into_row({kept, cells[second].vertices[beside]}, at.cell, second);
        }
    }
    if (rows.erase(edge_key(edge)) == 0) return;
    for (std::size_t i = 0; i < star.cells.size(); ++i) {
        const StarCell& at = star.cells[i];
        if (at.joins_previous) continue;
        const CellIndex second{first_new + i};
        rows[edge_key({edge[0], midpoint})].push_back(half(at, second, at.a));
        rows[edge_key({edge[1], midpoint})].push_back(half(at, second, at.b));
    }
}

void CellGraph::put_into_row(const EdgeVertices& edge, CellIndex old, CellIndex now) {
    const auto found = rows.find(edge_key(edge));
    if (found != rows.end()) std::ranges::replace(found->second, old, now);
}

/// Connects the halves with one another and with cells outside the star.
void CellGraph::halve(const StarCell& at, VertexIndex midpoint) {
    const CellIndex second = cells.append(cells[at.cell]);
    LinkedCell& one = cells[at.cell];
    LinkedCell& other = cells[second];
    const auto [lower, upper] = std::minmax(at.a, at.b);
    other.first_waiter = no_waiter;
    one.vertices[upper] = midpoint;
    other.vertices[lower] = midpoint;
    one.neighbours[lower] = second;
    other.neighbours[upper] = at.cell;
    if (const CellIndex outer = other.neighbours[lower]; !outer.is_none()) {
        auto& back = cells[outer].neighbours;
        back[position(back, at.cell)] = second;
    }
    next.push_back(next[at.cell]);
    next[at.cell] = second;
}

/// Connects the halves of two adjacent cells across the face on this side.
void CellGraph::join_halves(const StarCell& at, CellIndex second, std::uint8_t side,
                            const StarCell& beside, CellIndex second_neighbour) {
    cells[half(at, second, at.a)].neighbours[side] = half(beside, second_neighbour, beside.a);
    cells[half(at, second, at.b)].neighbours[side] = half(beside, second_neighbour, beside.b);
}

}  // namespace octetra::rivals
