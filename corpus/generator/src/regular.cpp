#include <octetra/generator/lattices.hpp>

#include "outward_faces.hpp"
#include "parameters.hpp"

namespace octetra::generator {

Mesh regular(double scale) {
    check_length(scale, "the scale");
    Mesh mesh;
    mesh.points = {{scale, scale, scale},
                   {scale, -scale, -scale},
                   {-scale, -scale, scale},
                   {-scale, scale, -scale}};
    mesh.cells = {{VertexIndex{0}, VertexIndex{1}, VertexIndex{2}, VertexIndex{3}}};
    for (const auto& [i, j, k] : outward_faces) {
        mesh.facets.push_back({VertexIndex{i}, VertexIndex{j}, VertexIndex{k}});
        mesh.facet_markers.push_back(static_cast<Marker>(mesh.facets.size()));
    }
    return mesh;
}

}  // namespace octetra::generator
