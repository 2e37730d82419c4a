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
}

void CellGraph::find_star(CellIndex c, Star& star) const {
    const auto& [a, b] = cell_edges[cells[c].longest];
    const auto& [i, j] = cell_edges[5U - cells[c].longest];  // the opposite edge
    star.cells.assign(1, {c, a, b, i, j});
    walk(star);
    if (star.is_ring) return;
    StarCell last = star.cells.back();
    std::swap(last.next, last.previous);
    star.cells.assign(1, last);
    walk(star);
}

/// From the only cell of a star to its end, or around.
void CellGraph::walk(Star& star) const {
    const StarCell first = star.cells.front();
    const VertexIndex a = cells[first.cell].vertices[first.a];
    const VertexIndex b = cells[first.cell].vertices[first.b];
    for (StarCell at = first;;) {
        const CellIndex beside = cells[at.cell].neighbours[at.next];
        star.is_ring = beside == first.cell;
        if (beside.is_none() || star.is_ring) return;
        const LinkedCell& cell = cells[beside];
        const std::uint8_t pa = position(cell.vertices, a);
        const std::uint8_t pb = position(cell.vertices, b);
        const std::uint8_t previous = position(cell.neighbours, at.cell);
        at = {beside, pa, pb, static_cast<std::uint8_t>(6 - pa - pb - previous), previous};
        star.cells.push_back(at);
    }
}

void CellGraph::bisect(const Star& star, VertexIndex midpoint) {
    const std::size_t first_new = cells.size();
    const std::size_t count = star.cells.size();
    const auto second = [&](std::size_t i) { return CellIndex{first_new + i}; };
    for (const StarCell& at : star.cells) halve(at, midpoint);
    for (std::size_t i = star.is_ring ? 0 : 1; i < count; ++i) {
        const std::size_t j = (i + count - 1) % count;
        join_halves(star.cells[i], second(i), star.cells[i].previous, star.cells[j], second(j));
        join_halves(star.cells[j], second(j), star.cells[j].next, star.cells[i], second(i));
    }
}

/// What the halves have to do with one another, and with what is not of the star.
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

/// Half by half, across the face on this side, what the halves of the cell beside are to those of
/// this one.
void CellGraph::join_halves(const StarCell& at, CellIndex second, std::uint8_t side,
                            const StarCell& beside, CellIndex second_beside) {
    cells[half(at, second, at.a)].neighbours[side] = half(beside, second_beside, beside.a);
    cells[half(at, second, at.b)].neighbours[side] = half(beside, second_beside, beside.b);
}

}  // namespace octetra::rivals
