#pragma once

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "support/meshes.hpp"

/// Meshes with tags of all kinds, and the same meshes renumbered.
namespace octetra::test {

/// Adds regions, facets on the boundary, some edges, and a marker for each vertex.
inline Mesh tagged(Mesh mesh) {
    list_boundary(mesh);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        mesh.regions.append(static_cast<Marker>(c.value() % 4));
    }
    for (CellIndex c{0}; c < mesh.cells.end_index(); c = CellIndex{c.value() + 7U}) {
        mesh.edges.append({mesh.cells[c][0], mesh.cells[c][2]});
        mesh.edge_markers.append(static_cast<Marker>(c.value()));
    }
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        mesh.point_markers.append(static_cast<Marker>(v.value() % 3));
    }
    return mesh;
}

template <class Vector>
void permute(Vector& values, const std::vector<std::size_t>& new_to_old) {
    Vector permuted;
    for (const std::size_t old : new_to_old) {
        permuted.push_back(
            static_cast<const std::vector<typename Vector::value_type>&>(values)[old]);
    }
    if (!values.empty()) values = permuted;
}

inline std::vector<std::size_t> shuffled(std::size_t count, std::mt19937_64& random) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::shuffle(order, random);
    return order;
}

/// Renumbers vertices, cells and facets, and permutes the corners of each. (Attributes are not
/// permuted.)
inline Mesh renumbered(Mesh mesh, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto vertex_order = shuffled(mesh.points.size(), random);
    IndexVector<VertexIndex, VertexIndex> new_number(vertex_order.size());
    for (std::size_t i = 0; i < vertex_order.size(); ++i) {
        new_number[VertexIndex{vertex_order[i]}] = VertexIndex{i};
    }
    permute(mesh.points, vertex_order);
    permute(mesh.point_markers, vertex_order);
    const auto rename = [&](auto& list) {
        for (auto& vertices : list) {
            for (VertexIndex& v : vertices) v = new_number[v];
        }
    };
    rename(mesh.cells);
    rename(mesh.facets);
    rename(mesh.edges);

    const auto cell_order = shuffled(mesh.cells.size(), random);
    permute(mesh.cells, cell_order);
    permute(mesh.regions, cell_order);
    for (CellVertices& cell : mesh.cells) {  // an even permutation of the corners
        std::rotate(cell.begin() + 1, cell.begin() + 1 + static_cast<int>(random() % 3),
                    cell.end());
        if (random() % 2 == 0) {
            std::swap(cell[0], cell[1]);
            std::swap(cell[2], cell[3]);
        }
    }
    const auto facet_order = shuffled(mesh.facets.size(), random);
    permute(mesh.facets, facet_order);
    permute(mesh.facet_markers, facet_order);
    for (FacetVertices& facet : mesh.facets) std::ranges::shuffle(facet, random);
    for (EdgeVertices& edge : mesh.edges) std::ranges::shuffle(edge, random);
    return mesh;
}

}  // namespace octetra::test
