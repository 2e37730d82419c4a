#pragma once

#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>

namespace octetra::test {

/// Everything that a program can read from a mesh, and the file that it would write. The
/// constructor is collective.
struct ObservedMesh {
    std::vector<Point> points;
    std::vector<CellVertices> cells;
    std::vector<FacetVertices> facets;
    std::vector<EdgeVertices> edges;
    std::vector<Marker> regions;
    std::vector<Marker> facet_markers;
    std::vector<distributed::GlobalVertex> numbers;
    distributed::Sharing<VertexIndex> sharing;
    Mesh whole;

    explicit ObservedMesh(const distributed::AdaptiveMesh& mesh)
        : points(mesh.points().begin(), mesh.points().end()),
          cells(mesh.cells().begin(), mesh.cells().end()),
          facets(mesh.facets().begin(), mesh.facets().end()),
          edges(mesh.edges().begin(), mesh.edges().end()),
          regions(mesh.regions()),
          facet_markers(mesh.facet_markers()),
          numbers(mesh.vertex_numbers().begin(), mesh.vertex_numbers().end()),
          sharing(mesh.vertex_sharing()),
          whole(mesh.collect()) {}
    friend bool operator==(const ObservedMesh&, const ObservedMesh&) = default;
};

}  // namespace octetra::test
