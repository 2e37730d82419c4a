#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <random>

#include "support/meshes.hpp"

namespace octetra::test {

/// Adds random markers, attributes, regions, tagged facets and edges.
inline Mesh marked(Mesh mesh, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto marker = [&] { return static_cast<Marker>(random() % 9) - 4; };
    list_boundary(mesh);
    for (const CellVertices& cell : mesh.cells) {
        mesh.regions.append(static_cast<Marker>(random() % 4));
        if (random() % 5 == 0) {  // also inner facets, some of them twice
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
    mesh.group_names = {{3, 1, "a region whose name is long enough to need memory"},
                        {3, 3, "r"},
                        {2, -4, "\"outer\" wall # 1"}};
    mesh.index_base = static_cast<std::uint32_t>(seed % 2);
    return mesh;
}

/// Gives duplicates the marker of the first occurrence, as in files.
template <class I, std::size_t N>
void mark_duplicates(const IndexVector<I, std::array<VertexIndex, N>>& list,
                     IndexVector<I, Marker>& markers) {
    std::map<std::array<VertexIndex, N>, Marker> known;
    for (I i{0}; i < list.end_index(); ++i) {
        auto key = list[i];
        std::ranges::sort(key);
        markers[i] = known.try_emplace(key, markers[i]).first->second;
    }
}

/// Marks about a third of the entities as corners, ridges or required.
inline Mesh featured(Mesh mesh, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const std::array counts{mesh.points.size(), mesh.edges.size(), mesh.facets.size(),
                            mesh.cells.size()};
    for (const Feature f : all_features) {
        for (std::uint64_t i = 0; i < counts.at(dimension_of(f)); ++i) {
            if (random() % 3 == 0) mesh.features[f].push_back(i);
        }
    }
    return mesh;
}

/// A lattice with everything that a file can describe.
inline Mesh marked_lattice(std::size_t n, std::uint64_t seed) {
    Mesh mesh = marked(perturbed_kuhn(n, 0.2, seed), seed);
    mark_duplicates(mesh.facets, mesh.facet_markers);
    mark_duplicates(mesh.edges, mesh.edge_markers);
    return mesh;
}

/// A mesh with everything that a file can contain; duplicates have the same marker.
inline Mesh full_mesh(std::size_t n, std::uint32_t index_base) {
    Mesh mesh = marked(perturbed_kuhn(n, 0.2, 1), index_base);
    for (Marker& marker : mesh.facet_markers) marker = 3;
    for (Marker& marker : mesh.edge_markers) marker = -4;
    return mesh;
}

}  // namespace octetra::test
