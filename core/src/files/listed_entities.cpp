#include "files/listed_entities.hpp"

#include <algorithm>
#include <vector>

#include <octetra/core/vertex_buckets.hpp>

namespace octetra {
namespace {

/// The first of the list that no cell has among its `sides` (faces or edges).
template <class I, std::size_t N, std::size_t Sides>
I find_stray(const Mesh& mesh, const IndexVector<I, std::array<VertexIndex, N>>& list,
             const std::array<std::array<std::uint8_t, N>, Sides>& sides) {
    if (list.empty()) return I::none();
    const VertexBuckets<I, N> buckets(list, mesh.points.size());
    std::vector<bool> met(list.size(), false);
    for (const CellVertices& cell : mesh.cells) {
        for (const auto& side : sides) {
            std::array<VertexIndex, N> vertices;
            for (std::size_t k = 0; k < N; ++k) vertices[k] = cell[side[k]];
            buckets.find(vertices, [&](I i) { met[i.value()] = true; });
        }
    }
    const auto stray = std::ranges::find(met, false);
    return stray == met.end() ? I::none() : I{static_cast<std::size_t>(stray - met.begin())};
}

}  // namespace

FacetIndex find_stray_facet(const Mesh& mesh) { return find_stray(mesh, mesh.facets, cell_faces); }

EdgeIndex find_stray_edge(const Mesh& mesh) { return find_stray(mesh, mesh.edges, cell_edges); }

}  // namespace octetra
