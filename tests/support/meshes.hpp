#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/orientation.hpp>

/// Meshes that tests construct without the generator.
namespace octetra::test {

/// A mesh of these points and cells; the orientation of inverted cells is corrected.
inline Mesh mesh_of(const std::vector<Point>& points,
                    const std::vector<std::array<std::size_t, 4>>& cells) {
    Mesh mesh;
    for (const Point& p : points) mesh.points.append(p);
    for (const auto& [a, b, c, d] : cells) {
        CellVertices cell{VertexIndex{a}, VertexIndex{b}, VertexIndex{c}, VertexIndex{d}};
        if (orientation(points[a], points[b], points[c], points[d]) < 0)
            std::swap(cell[2], cell[3]);
        mesh.cells.append(cell);
    }
    return mesh;
}

inline Mesh one_cell(const std::array<Point, 4>& corners) {
    return mesh_of({corners.begin(), corners.end()}, {{0, 1, 2, 3}});
}

/// A cell with the least and the greatest permitted coordinates, and some with full mantissas.
inline Mesh extreme_cell() {
    const double largest = std::nextafter(coordinate_limit, 0.0);
    constexpr double smallest = std::numeric_limits<double>::denorm_min();
    return one_cell({{{-0.0, 0, smallest},
                      {largest, -smallest, 0},
                      {0, 0x1.fffffffffffffp-1022, -largest},
                      {0.1, -1.0 / 3, 5e-310}}});
}

/// nx * ny * nz cubes of side `side`, each of six cells round its diagonal: a lattice full of ties.
inline Mesh kuhn(std::size_t nx, std::size_t ny, std::size_t nz, double side = 1) {
    std::vector<Point> points;
    for (std::size_t k = 0; k <= nz; ++k) {
        for (std::size_t j = 0; j <= ny; ++j) {
            for (std::size_t i = 0; i <= nx; ++i) {
                points.push_back({static_cast<double>(i) * side, static_cast<double>(j) * side,
                                  static_cast<double>(k) * side});
            }
        }
    }
    const std::array<std::size_t, 3> stride{1, nx + 1, (nx + 1) * (ny + 1)};
    std::vector<std::array<std::size_t, 4>> cells;
    for (std::size_t k = 0; k < nz; ++k) {
        for (std::size_t j = 0; j < ny; ++j) {
            for (std::size_t i = 0; i < nx; ++i) {
                const std::size_t low = i * stride[0] + j * stride[1] + k * stride[2];
                std::array<std::size_t, 3> axis{0, 1, 2};
                do {  // one cell for each path from the low corner to the high one
                    const std::size_t second = low + stride[axis[0]];
                    const std::size_t third = second + stride[axis[1]];
                    cells.push_back({low, second, third, third + stride[axis[2]]});
                } while (std::ranges::next_permutation(axis).found);
            }
        }
    }
    return mesh_of(points, cells);
}

/// The same lattice with every vertex moved at random by up to `amount` of the side, on a grid of
/// 2^-20: hardly any ties, and coordinates that stay exact through many levels.
inline Mesh perturbed_kuhn(std::size_t n, double amount, std::uint64_t seed) {
    Mesh mesh = kuhn(n, n, n);
    std::mt19937_64 random(seed);
    constexpr double grid = 0x1p-20;
    const auto steps = static_cast<std::uint64_t>(amount / grid);
    const auto move = [&] {
        const auto step = static_cast<double>(random() % (2 * steps + 1));
        return (step - static_cast<double>(steps)) * grid;
    };
    for (Point& p : mesh.points) p = {p.x + move(), p.y + move(), p.z + move()};
    return mesh;
}

/// Cells that grow along a spiral like the chambers of a shell, each with a face of the next, in
/// random order: marking an edge of the smallest propagates through all cells, one after the other.
inline Mesh shell(std::size_t cell_count, std::uint64_t seed) {
    std::vector<Point> points;
    Point next{1, 0.25, -0.125};
    for (std::size_t i = 0; i < cell_count + 3; ++i) {
        points.push_back(next);
        next = {1.125 * next.z, 1.125 * next.x, 1.125 * next.y};
    }
    std::vector<std::array<std::size_t, 4>> cells;
    for (std::size_t i = 0; i < cell_count; ++i) cells.push_back({i, i + 1, i + 2, i + 3});
    std::shuffle(cells.begin() + 1, cells.end(), std::mt19937_64(seed));  // the smallest is first
    return mesh_of(points, cells);
}

/// Lists every boundary face as a facet with the marker 1 + its number modulo 5.
inline void list_boundary(Mesh& mesh) {
    std::vector<std::pair<std::array<VertexIndex, 3>, FacetVertices>> faces;
    for (const CellVertices& cell : mesh.cells) {
        for (const auto& [i, j, k] : cell_faces) {
            FacetVertices face{cell[i], cell[j], cell[k]};
            auto sorted = face;
            std::ranges::sort(sorted);
            faces.emplace_back(sorted, face);
        }
    }
    std::ranges::sort(faces);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const bool twice = (f > 0 && faces[f - 1].first == faces[f].first) ||
                           (f + 1 < faces.size() && faces[f + 1].first == faces[f].first);
        if (twice) continue;
        const FacetIndex number = mesh.facets.append(faces[f].second);
        mesh.facet_markers.append(1 + static_cast<Marker>(number.value() % 5));
    }
}

/// Removes all tags, and the vertices that belong to no cell.
inline void drop_unused(Mesh& mesh) {
    std::vector<char> used(mesh.points.size(), 0);
    for (const CellVertices& cell : mesh.cells) {
        for (const VertexIndex v : cell) used[v.value()] = 1;
    }
    Mesh kept;
    std::vector<VertexIndex> new_number(mesh.points.size());
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        if (used[v.value()] != 0) new_number[v.value()] = kept.points.append(mesh.points[v]);
    }
    for (CellVertices cell : mesh.cells) {
        for (VertexIndex& v : cell) v = new_number[v.value()];
        kept.cells.push_back(cell);
    }
    mesh = kept;
}

/// The regular tetrahedron and other shapes with integer coordinates.
inline const std::array<Point, 4> regular_corners{
    {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
inline const std::array<Point, 4> kuhn_corners{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}};
inline const std::array<Point, 4> cube_corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
inline const std::array<Point, 4> sommerville_corners{
    {{0, 0, 0}, {2, 0, 0}, {1, 1, 1}, {1, 1, -1}}};
inline const std::array<Point, 4> tie_free_corners{{{0, 0, 0}, {7, 0, 0}, {2, 5, 0}, {1, 2, 6}}};
inline const std::array<Point, 4> type_o_corners{
    {{99, 99, 101}, {102, -100, -98}, {-99, 98, -98}, {-98, -102, 98}}};

}  // namespace octetra::test
