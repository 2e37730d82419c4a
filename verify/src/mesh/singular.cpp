#include "mesh/checks.hpp"

namespace octetra::verify {

/// Counts singular edges and vertices. The link of a vertex consists of the faces of its cells
/// opposite it: the vertex's edges, faces and cells correspond to the link's vertices, edges and
/// triangles. The link of an interior vertex of a manifold is a sphere, with Euler characteristic
/// 2; on the boundary it is a disc, with characteristic 1.
void count_singular(const JudgedMesh& judged, Facts& facts) {
    const std::size_t vertex_count = judged.mesh.points.size();
    std::vector<std::int64_t> characteristic(vertex_count, 0);
    std::vector<char> used(vertex_count, 0);
    std::vector<char> on_boundary(vertex_count, 0);
    std::vector<char> singular(vertex_count, 0);

    judged.edges.for_each([&](const EdgeVertices& edge) {
        for (const VertexIndex v : edge) {
            ++characteristic[v.value()];
            used[v.value()] = 1;
        }
    });
    std::vector<FacetVertices> boundary;
    judged.faces.for_each_group([&](const FacetVertices& face, auto entries) {
        for (const VertexIndex v : face) --characteristic[v.value()];
        if (entries.size() != 1) return;
        boundary.push_back(face);
        for (const VertexIndex v : face) on_boundary[v.value()] = 1;
    });
    for (CellIndex c{0}; c < judged.mesh.cells.end_index(); ++c) {
        if (!judged.is_sound(c)) continue;
        for (const VertexIndex v : judged.mesh.cells[c]) ++characteristic[v.value()];
    }

    const Buckets<2> boundary_edges(vertex_count, [&](auto&& visit) {
        for (const FacetVertices& face : boundary) {
            for (const auto& [i, j] : triangle_edges) visit(EdgeVertices{face[i], face[j]}, 0);
        }
    });
    boundary_edges.for_each_group([&](const EdgeVertices& edge, auto faces) {
        if (faces.size() == 2) return;
        if (judged.owns(edge)) ++facts.singular_edges;
        for (const VertexIndex v : edge) singular[v.value()] = 1;
    });
    for (std::size_t v = 0; v < vertex_count; ++v) {
        const std::int64_t regular = on_boundary[v] != 0 ? 1 : 2;
        if (used[v] != 0 && judged.owns(VertexIndex{v}) &&
            (singular[v] != 0 || characteristic[v] != regular)) {
            ++facts.singular_vertices;
        }
    }
}

}  // namespace octetra::verify
