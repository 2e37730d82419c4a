#pragma once

#include <random>

#include "support/meshes.hpp"

namespace octetra::test {

/// Everything that a mesh can carry.
inline Mesh marked(Mesh mesh, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto marker = [&] { return static_cast<Marker>(random() % 9) - 4; };
    list_boundary(mesh);
    for (const CellVertices& cell : mesh.cells) {
        mesh.regions.append(static_cast<Marker>(random() % 4));
        if (random() % 5 == 0) {  // inner facets too, some of them twice
            mesh.facets.append({cell[2], cell[0], cell[1]});
            mesh.facet_markers.append(marker());
        }
        if (random() % 5 == 0) {
            mesh.edges.append({cell[3], cell[1]});
            mesh.edge_markers.append(marker());
        }
    }
    mesh.attributes_per_point = 2;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        mesh.point_markers.append(marker());
        mesh.point_attributes.push_back(static_cast<double>(random()) * 0x1p-60);
        mesh.point_attributes.push_back(static_cast<double>(v));
    }
    mesh.index_base = static_cast<std::uint32_t>(seed % 2);
    return mesh;
}

}  // namespace octetra::test
