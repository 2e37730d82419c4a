#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/orientation.hpp>

/// Quantities of meshes, computed in the simplest way from their lists.
namespace octetra::generator::test {

inline FacetVertices sorted(FacetVertices face) {
    std::ranges::sort(face);
    return face;
}

/// The cells that have each face, by the face's ascending corners.
inline std::map<FacetVertices, std::vector<CellIndex>> cells_of_faces(const Mesh& mesh) {
    std::map<FacetVertices, std::vector<CellIndex>> cells;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (const auto& [i, j, k] : cell_faces) {
            const CellVertices& v = mesh.cells[c];
            cells[sorted({v[i], v[j], v[k]})].push_back(c);
        }
    }
    return cells;
}

inline std::set<EdgeVertices> edges_of(const Mesh& mesh) {
    std::set<EdgeVertices> edges;
    for (const CellVertices& cell : mesh.cells) {
        for (const auto& [i, j] : cell_edges) {
            edges.insert({std::min(cell[i], cell[j]), std::max(cell[i], cell[j])});
        }
    }
    return edges;
}

inline std::set<FacetVertices> boundary_of(const Mesh& mesh) {
    std::set<FacetVertices> boundary;
    for (const auto& [face, cells] : cells_of_faces(mesh)) {
        if (cells.size() == 1) boundary.insert(face);
    }
    return boundary;
}

/// The tagged facets, by their ascending corners.
inline std::set<FacetVertices> tagged_facets(const Mesh& mesh) {
    std::set<FacetVertices> tagged;
    for (const FacetVertices& facet : mesh.facets) tagged.insert(sorted(facet));
    return tagged;
}

struct Counts {
    std::size_t vertices;
    std::size_t edges;
    std::size_t faces;
    std::size_t cells;
    std::size_t boundary_faces;

    friend bool operator==(const Counts&, const Counts&) = default;
};

inline Counts counts_of(const Mesh& mesh) {
    return {mesh.points.size(), edges_of(mesh).size(), cells_of_faces(mesh).size(),
            mesh.cells.size(), boundary_of(mesh).size()};
}

/// Vertices - edges + faces - cells: 1 for a ball, 0 for a solid torus.
inline int euler_characteristic(const Mesh& mesh) {
    const Counts n = counts_of(mesh);
    return static_cast<int>(n.vertices + n.faces) - static_cast<int>(n.edges + n.cells);
}

inline std::array<Point, 4> corners_of(const Mesh& mesh, CellIndex c) {
    const auto& [i, j, k, l] = mesh.cells[c];
    return {mesh.points[i], mesh.points[j], mesh.points[k], mesh.points[l]};
}

inline bool all_positively_oriented(const Mesh& mesh) {
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const auto [p, q, r, s] = corners_of(mesh, c);
        if (orientation(p, q, r, s) <= 0) return false;
    }
    return true;
}

/// Six times the volume of a cell; exact if the coordinates are small whole numbers.
inline double six_volumes(const std::array<Point, 4>& corners) {
    const auto& [a, b, c, d] = corners;
    const Point u{b.x - a.x, b.y - a.y, b.z - a.z};
    const Point v{c.x - a.x, c.y - a.y, c.z - a.z};
    const Point w{d.x - a.x, d.y - a.y, d.z - a.z};
    return u.x * (v.y * w.z - v.z * w.y) - u.y * (v.x * w.z - v.z * w.x) +
           u.z * (v.x * w.y - v.y * w.x);
}

inline double six_volumes(const Mesh& mesh) {
    double sum = 0;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) sum += six_volumes(corners_of(mesh, c));
    return sum;
}

inline std::vector<Point> corners_of(const Mesh& mesh, FacetIndex f) {
    const auto& [i, j, k] = mesh.facets[f];
    return {mesh.points[i], mesh.points[j], mesh.points[k]};
}

inline std::map<Marker, std::size_t> facets_by_marker(const Mesh& mesh) {
    std::map<Marker, std::size_t> counts;
    for (const Marker marker : mesh.facet_markers) ++counts[marker];
    return counts;
}

/// Returns whether every facet has three different corners that are counterclockwise as seen from
/// outside, that is, with the opposite corner of its cell behind it.
inline bool facets_face_outwards(const Mesh& mesh) {
    const auto cells = cells_of_faces(mesh);
    return std::ranges::all_of(mesh.facets, [&](const FacetVertices& facet) {
        const CellVertices& cell = mesh.cells[cells.at(sorted(facet)).front()];
        const VertexIndex opposite = *std::ranges::find_if(
            cell, [&](VertexIndex v) { return std::ranges::find(facet, v) == facet.end(); });
        const auto& p = mesh.points;
        return orientation(p[facet[0]], p[facet[1]], p[facet[2]], p[opposite]) < 0;
    });
}

}  // namespace octetra::generator::test
