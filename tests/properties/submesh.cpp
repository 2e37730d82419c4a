#include "properties/submesh.hpp"

#include <algorithm>
#include <set>

namespace octetra::properties {
namespace {

/// The faces or edges of the cells, each with its vertices ascending.
template <std::size_t N, class Positions>
std::set<std::array<VertexIndex, N>> sides(const Mesh& mesh, const Positions& positions) {
    std::set<std::array<VertexIndex, N>> result;
    for (const CellVertices& cell : mesh.cells) {
        for (const auto& position : positions) {
            std::array<VertexIndex, N> side;
            for (std::size_t k = 0; k < N; ++k) side[k] = cell[position[k]];
            std::ranges::sort(side);
            result.insert(side);
        }
    }
    return result;
}

template <class I, std::size_t N>
void keep_tagged(IndexVector<I, std::array<VertexIndex, N>>& list, IndexVector<I, Marker>& markers,
                 const std::set<std::array<VertexIndex, N>>& wanted) {
    I kept{0};
    for (I i{0}; i < list.end_index(); ++i) {
        auto sorted = list[i];
        std::ranges::sort(sorted);
        if (!wanted.contains(sorted)) continue;
        list[kept] = list[i];
        if (!markers.empty()) markers[kept] = markers[i];
        ++kept;
    }
    list.resize(kept.value());
    if (!markers.empty()) markers.resize(kept.value());
}

/// Removes the vertices that belong to no cell, and renumbers the others.
void drop_unused_vertices(Mesh& mesh) {
    IndexVector<VertexIndex, VertexIndex> number(mesh.points.size(), VertexIndex::none());
    for (const CellVertices& cell : mesh.cells) {
        for (const VertexIndex v : cell) number[v] = v;
    }
    const std::size_t attributes = mesh.attributes_per_point;
    VertexIndex next{0};
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        if (number[v].is_none()) continue;
        mesh.points[next] = mesh.points[v];
        if (!mesh.point_markers.empty()) mesh.point_markers[next] = mesh.point_markers[v];
        for (std::size_t k = 0; k < attributes; ++k) {
            mesh.point_attributes[next.value() * attributes + k] =
                mesh.point_attributes[v.value() * attributes + k];
        }
        number[v] = next;
        ++next;
    }
    mesh.points.resize(next.value());
    if (!mesh.point_markers.empty()) mesh.point_markers.resize(next.value());
    mesh.point_attributes.resize(next.value() * attributes);
    const auto renumber = [&](auto& list) {
        for (auto& vertices : list) {
            for (VertexIndex& v : vertices) v = number[v];
        }
    };
    renumber(mesh.cells);
    renumber(mesh.facets);
    renumber(mesh.edges);
}

}  // namespace

Mesh submesh(const Mesh& mesh, const std::vector<char>& keep) {
    Mesh part = mesh;
    part.cells.clear();
    part.regions.clear();
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        if (keep[c.value()] == 0) continue;
        part.cells.append(mesh.cells[c]);
        if (!mesh.regions.empty()) part.regions.append(mesh.regions[c]);
    }
    if (!part.facets.empty()) {
        keep_tagged(part.facets, part.facet_markers, sides<3>(part, cell_faces));
    }
    if (!part.edges.empty()) keep_tagged(part.edges, part.edge_markers, sides<2>(part, cell_edges));
    drop_unused_vertices(part);
    return part;
}

}  // namespace octetra::properties
