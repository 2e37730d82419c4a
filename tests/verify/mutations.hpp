#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <octetra/core/mesh.hpp>

/// Modifications that break a mesh, for tests of the verifier. Each changes one thing, and keeps
/// the related lists (tags, markers) consistent.
namespace octetra::test {

inline void move_vertex(Mesh& mesh, VertexIndex v, const Point& to) { mesh.points[v] = to; }

/// Moves by one unit in the last place of x, outward.
inline void shift_by_an_ulp(Mesh& mesh, VertexIndex v) {
    double& x = mesh.points[v].x;
    x = std::nextafter(x, std::numeric_limits<double>::infinity());
}

template <class I, class T>
void erase(IndexVector<I, T>& list, I i) {
    if (!list.empty()) list.erase(list.begin() + static_cast<std::ptrdiff_t>(i.value()));
}

inline void drop_cell(Mesh& mesh, CellIndex c) {
    erase(mesh.cells, c);
    erase(mesh.regions, c);
}

inline void append_cell(Mesh& mesh, const CellVertices& cell, CellIndex like) {
    mesh.cells.push_back(cell);
    if (!mesh.regions.empty()) mesh.regions.push_back(mesh.regions[like]);
}

inline void duplicate_cell(Mesh& mesh, CellIndex c) { append_cell(mesh, mesh.cells[c], c); }

/// Inverts a cell.
inline void flip_cell(Mesh& mesh, CellIndex c) { std::swap(mesh.cells[c][2], mesh.cells[c][3]); }

/// Replaces one vertex of a cell.
inline void replace_corner(Mesh& mesh, CellIndex c, std::size_t corner, VertexIndex v) {
    mesh.cells[c][corner] = v;
}

inline VertexIndex append_vertex(Mesh& mesh, const Point& p) {
    const VertexIndex v = mesh.points.append(p);
    if (!mesh.point_markers.empty()) mesh.point_markers.push_back(0);
    mesh.point_attributes.resize(mesh.points.size() * mesh.attributes_per_point, 0.0);
    return v;
}

/// Duplicates a vertex: the cell `c` gets its own copy at the same coordinates.
inline void unmerge_vertex(Mesh& mesh, CellIndex c, std::size_t corner) {
    const VertexIndex old = mesh.cells[c][corner];
    const VertexIndex copy = append_vertex(mesh, mesh.points[old]);
    if (!mesh.point_markers.empty()) mesh.point_markers[copy] = mesh.point_markers[old];
    for (std::size_t k = 0; k < mesh.attributes_per_point; ++k) {
        mesh.point_attributes[copy.value() * mesh.attributes_per_point + k] =
            mesh.point_attributes[old.value() * mesh.attributes_per_point + k];
    }
    mesh.cells[c][corner] = copy;
}

/// Bisects one cell at an edge, and no other cell at this edge.
inline void bisect_alone(Mesh& mesh, CellIndex c, std::size_t edge) {
    const auto [i, j] = cell_edges[edge];
    const CellVertices cell = mesh.cells[c];
    const VertexIndex m = append_vertex(mesh, midpoint(mesh.points[cell[i]], mesh.points[cell[j]]));
    CellVertices other = cell;
    other[i] = m;
    mesh.cells[c][j] = m;
    append_cell(mesh, other, c);
}

/// Bisects all cells at the edge a b.
inline void bisect_edge(Mesh& mesh, VertexIndex a, VertexIndex b) {
    const VertexIndex m = append_vertex(mesh, midpoint(mesh.points[a], mesh.points[b]));
    const std::size_t count = mesh.cells.size();
    for (CellIndex c{0}; c < CellIndex{count}; ++c) {
        CellVertices& cell = mesh.cells[c];
        const auto at_a = std::find(cell.begin(), cell.end(), a);
        const auto at_b = std::find(cell.begin(), cell.end(), b);
        if (at_a == cell.end() || at_b == cell.end()) continue;
        CellVertices other = cell;
        other[static_cast<std::size_t>(at_a - cell.begin())] = m;
        *at_b = m;
        append_cell(mesh, other, c);
    }
}

/// Merges two cells that a bisection made: those that have `m`, the same two further vertices, and
/// one end each of the edge a b. Returns false if there are none.
inline bool merge_two_cells(Mesh& mesh, VertexIndex m, VertexIndex a, VertexIndex b) {
    const auto position = [](const CellVertices& cell, VertexIndex v) {
        return static_cast<std::size_t>(std::find(cell.begin(), cell.end(), v) - cell.begin());
    };
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const CellVertices cell = mesh.cells[c];
        if (position(cell, m) == 4 || position(cell, a) == 4) continue;
        CellVertices partner = cell;
        partner[position(cell, a)] = b;
        std::sort(partner.begin(), partner.end());
        for (CellIndex d{0}; d < mesh.cells.end_index(); ++d) {
            CellVertices sorted = mesh.cells[d];
            std::sort(sorted.begin(), sorted.end());
            if (sorted != partner) continue;
            mesh.cells[c][position(cell, m)] = b;
            drop_cell(mesh, d);
            return true;
        }
    }
    return false;
}

}  // namespace octetra::test
