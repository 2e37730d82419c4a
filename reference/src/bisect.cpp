#include "bisect.hpp"

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/orientation.hpp>

namespace octetra::reference {
namespace {

void check_countable(std::size_t count, std::string_view what) {
    if (count >= VertexIndex::limit) {
        throw InputError(
            fmt::format("the refined mesh would have more than {} {}", VertexIndex::limit, what));
    }
}

/// Returns the marker of the midpoint of each edge of the table: the marker of the edge, if tagged;
/// otherwise the smallest marker of the tagged facets that contain the edge; otherwise 0.
IndexVector<EdgeIndex, Marker> midpoint_markers(const Mesh& mesh, const EdgeTable& table) {
    IndexVector<EdgeIndex, Marker> markers(table.edges.size(), 0);
    EdgeSet met(table.edges.size(), false);
    const auto take = [&](EdgeIndex e, Marker marker) {
        markers[e] = met[e] != 0 ? std::min(markers[e], marker) : marker;
        met[e] = true;
    };
    for (FacetIndex f{0}; f < mesh.facet_markers.end_index(); ++f) {
        for (const auto& [i, j] : triangle_edges) {
            take(find_edge(table, mesh.facets[f][i], mesh.facets[f][j]), mesh.facet_markers[f]);
        }
    }
    // A tagged edge takes precedence over facets; if it is listed twice, the smaller marker is
    // used.
    met.assign(met.size(), false);
    for (EdgeIndex tagged{0}; tagged < mesh.edge_markers.end_index(); ++tagged) {
        take(find_edge(table, mesh.edges[tagged][0], mesh.edges[tagged][1]),
             mesh.edge_markers[tagged]);
    }
    return markers;
}

/// Sets the vertices of `fine`: those of `mesh`, then the midpoints of the edges.
void bisect_edges(const Mesh& mesh, const EdgeTable& table, const std::vector<EdgeVertices>& edges,
                  Refinement& fine) {
    const auto markers = midpoint_markers(mesh, table);
    const std::size_t attributes = mesh.attributes_per_point;
    fine.mesh.points = mesh.points;
    fine.mesh.point_markers = mesh.point_markers;
    fine.mesh.attributes_per_point = attributes;
    fine.mesh.point_attributes = mesh.point_attributes;

    for (const auto& [a, b] : edges) {
        check_countable(fine.mesh.points.size() + 1, "vertices");
        fine.mesh.points.append(midpoint(mesh.points[a], mesh.points[b]));
        fine.maps.midpoint_to_edge.push_back({a, b});
        if (!mesh.point_markers.empty()) {
            fine.mesh.point_markers.append(markers[find_edge(table, a, b)]);
        }
        for (std::size_t k = 0; k < attributes; ++k) {
            fine.mesh.point_attributes.push_back(
                mean(mesh.point_attributes[a.value() * attributes + k],
                     mesh.point_attributes[b.value() * attributes + k]));
        }
    }
}

/// Throws InputError if the child is flat or inverted: a rounded midpoint need not lie on the edge
/// that it bisects, which can invert a thin child.
void check_child(const CellVertices& child, const Mesh& fine, CellIndex parent, int level,
                 std::uint32_t index_base) {
    const auto& p = fine.points;
    const bool finite = std::ranges::all_of(child, [&](VertexIndex v) { return is_finite(p[v]); });
    const int sign = finite ? orientation(p[child[0]], p[child[1]], p[child[2]], p[child[3]]) : 0;
    if (sign > 0) return;
    throw InputError(fmt::format(
        "cell {}, level {}: bisection would make a child that is {}, because its midpoints cannot "
        "be rounded to double precision well enough; the cell is too small for its coordinates, "
        "or these are too large to be added",
        parent.value() + index_base, level, sign < 0 ? "inverted" : "flat"));
}

/// Throws InputError if the level would make more than `max_cells` cells. Called before the mesh is
/// built.
void check_allowed(const Mesh& mesh, const EdgeTable& table, const EdgeToMidpoint& midpoints,
                   std::size_t max_cells, int level) {
    if (max_cells == unlimited) return;
    std::size_t count = 0;
    for (const auto& cell : mesh.cells) count += pieces_of(cell, mesh, table, midpoints).size();
    if (count <= max_cells || count == mesh.cells.size()) return;
    throw InputError(
        fmt::format("level {} would make {} cells, more than the {} allowed: mark fewer cells or "
                    "levels, or allow more",
                    level, count, max_cells));
}

/// The number of the first piece of each entity, followed by the total number of pieces.
using FirstPieces = std::vector<std::uint64_t>;

FirstPieces bisect_cells(const Mesh& mesh, const EdgeTable& table, const EdgeToMidpoint& midpoints,
                         const IndexVector<CellIndex, CellIndex>& cell_to_parent, int level,
                         Refinement& fine) {
    FirstPieces first;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        first.push_back(fine.mesh.cells.size());
        const auto children = pieces_of(mesh.cells[c], mesh, table, midpoints);
        check_countable(fine.mesh.cells.size() + children.size(), "cells");
        for (const CellVertices& child : children) {
            if (children.size() > 1) {
                check_child(child, fine.mesh, cell_to_parent[c], level, mesh.index_base);
            }
            fine.mesh.cells.append(child);
            fine.maps.cell_to_parent.append(cell_to_parent[c]);
            if (!mesh.regions.empty()) fine.mesh.regions.append(mesh.regions[c]);
        }
    }
    first.push_back(fine.mesh.cells.size());
    return first;
}

/// Bisects tagged facets or edges in the same way as the cells that contain them.
template <class I, std::size_t N>
FirstPieces bisect_tagged(const IndexVector<I, std::array<VertexIndex, N>>& list,
                          const IndexVector<I, Marker>& markers, const Mesh& mesh,
                          const EdgeTable& table, const EdgeToMidpoint& midpoints,
                          IndexVector<I, std::array<VertexIndex, N>>& fine_list,
                          IndexVector<I, Marker>& fine_markers) {
    FirstPieces first;
    for (I i{0}; i < list.end_index(); ++i) {
        first.push_back(fine_list.size());
        for (const auto& piece : pieces_of(list[i], mesh, table, midpoints)) {
            check_countable(fine_list.size() + 1, "tagged facets or edges");
            fine_list.append(piece);
            if (!markers.empty()) fine_markers.append(markers[i]);
        }
    }
    first.push_back(fine_list.size());
    return first;
}

}  // namespace

std::vector<BisectedEdge> bisected_edges(const Mesh& mesh, const EdgeTable& table,
                                         const EdgeToMidpoint& midpoints,
                                         const std::vector<VertexIndex>& vertices) {
    std::vector<BisectedEdge> edges;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        for (std::size_t j = i + 1; j < vertices.size(); ++j) {
            const VertexIndex midpoint = midpoints[find_edge(table, vertices[i], vertices[j])];
            if (!midpoint.is_none()) edges.push_back({{vertices[i], vertices[j]}, midpoint});
        }
    }
    std::ranges::sort(edges, [&](const BisectedEdge& e, const BisectedEdge& f) {
        return longer(segment(mesh, e.ends), segment(mesh, f.ends));
    });
    return edges;
}

EdgeToMidpoint midpoints_of(const std::vector<EdgeVertices>& edges, const EdgeTable& table,
                            const Mesh& mesh) {
    EdgeToMidpoint midpoints(table.edges.size(), VertexIndex::none());
    VertexIndex next = mesh.points.end_index();
    for (const auto& [a, b] : edges) {
        midpoints[find_edge(table, a, b)] = next;
        ++next;
    }
    return midpoints;
}

Refinement bisect_mesh(const Refinement& coarse, const std::vector<EdgeVertices>& edges, int level,
                       std::size_t max_cells) {
    const Mesh& mesh = coarse.mesh;
    const EdgeTable table = number_edges(mesh);
    Refinement fine;
    fine.mesh.index_base = mesh.index_base;
    fine.mesh.group_names = mesh.group_names;
    fine.maps.first_midpoint = coarse.maps.first_midpoint;
    fine.maps.midpoint_to_edge = coarse.maps.midpoint_to_edge;
    bisect_edges(mesh, table, edges, fine);
    const EdgeToMidpoint midpoints = midpoints_of(edges, table, mesh);
    check_allowed(mesh, table, midpoints, max_cells, level);
    const std::array<FirstPieces, 4> first_pieces{
        FirstPieces{},  // vertices keep their numbers
        bisect_tagged(mesh.edges, mesh.edge_markers, mesh, table, midpoints, fine.mesh.edges,
                      fine.mesh.edge_markers),
        bisect_tagged(mesh.facets, mesh.facet_markers, mesh, table, midpoints, fine.mesh.facets,
                      fine.mesh.facet_markers),
        bisect_cells(mesh, table, midpoints, coarse.maps.cell_to_parent, level, fine)};
    fine.mesh.features = mesh.features;
    for (const Feature f : all_features) {
        if (dimension_of(f) == 0) continue;
        const FirstPieces& first = first_pieces.at(dimension_of(f));
        fine.mesh.features[f].clear();
        for (const std::uint64_t i : mesh.features[f]) {
            for (auto p = first[i]; p < first[i + 1]; ++p) fine.mesh.features[f].push_back(p);
        }
    }
    return fine;
}

Refinement unrefined(const Mesh& mesh) {
    Refinement result;
    result.mesh = mesh;
    result.maps.first_midpoint = mesh.points.end_index();
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) result.maps.cell_to_parent.append(c);
    return result;
}

}  // namespace octetra::reference
