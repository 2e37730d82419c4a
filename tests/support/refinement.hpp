#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>

namespace octetra::test {

inline Corners corners_of(const Mesh& mesh, CellIndex c) {
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.points[mesh.cells[c][k]];
    return corners;
}

/// Returns whether any cell has two edges of the same length, as computed by the edge order.
inline bool has_ties(const Mesh& mesh) {
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const Corners corners = corners_of(mesh, c);
        std::set<double> lengths;
        for (const auto& [i, j] : cell_edges) {
            lengths.insert(squared_length({corners[i], corners[j]}));
        }
        if (lengths.size() < 6) return true;
    }
    return false;
}

/// The cells by the coordinates of their corners, independent of numbering: each with ascending
/// corners and its region tag, all ascending.
inline std::vector<std::pair<Corners, Marker>> geometry(const Mesh& mesh) {
    std::vector<std::pair<Corners, Marker>> cells;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        Corners corners = corners_of(mesh, c);
        std::ranges::sort(corners, std::less<>{});
        cells.emplace_back(corners, mesh.regions.empty() ? 0 : mesh.regions[c]);
    }
    std::ranges::sort(cells, std::less<>{});
    return cells;
}

/// Tagged facets or edges with their markers, likewise.
template <class I, std::size_t N>
std::vector<std::pair<std::array<Point, N>, Marker>> geometry(
    const Mesh& mesh, const IndexVector<I, std::array<VertexIndex, N>>& list,
    const IndexVector<I, Marker>& markers) {
    std::vector<std::pair<std::array<Point, N>, Marker>> result;
    for (I i{0}; i < list.end_index(); ++i) {
        std::array<Point, N> points;
        for (std::size_t k = 0; k < N; ++k) points[k] = mesh.points[list[i][k]];
        std::ranges::sort(points, std::less<>{});
        result.emplace_back(points, markers.empty() ? 0 : markers[i]);
    }
    std::ranges::sort(result, std::less<>{});
    return result;
}

__extension__ using Int128 = __int128;

/// Six times the volume of a cell in units of scale^-3, as an integer. Its corners multiplied by
/// `scale` must be integers of at most 40 bits.
inline Int128 exact_volume(const Corners& corners, double scale) {
    std::array<std::array<Int128, 3>, 4> p;
    for (std::size_t i = 0; i < 4; ++i) {
        p[i] = {static_cast<std::int64_t>(corners[i].x * scale),
                static_cast<std::int64_t>(corners[i].y * scale),
                static_cast<std::int64_t>(corners[i].z * scale)};
    }
    std::array<std::array<Int128, 3>, 3> m;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) m[i][k] = p[i + 1][k] - p[0][k];
    }
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// For each edge of the mesh the number of its cells.
inline std::map<EdgeVertices, std::size_t> cells_at_edges(const Mesh& mesh) {
    std::map<EdgeVertices, std::size_t> cells;
    for (const CellVertices& cell : mesh.cells) {
        for (const auto& [i, j] : cell_edges) {
            ++cells[{std::min(cell[i], cell[j]), std::max(cell[i], cell[j])}];
        }
    }
    return cells;
}

}  // namespace octetra::test
