#include "files/listed_entities.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace octetra {
namespace {

template <std::size_t N>
std::array<VertexIndex, N> sorted(std::array<VertexIndex, N> vertices) {
    std::ranges::sort(vertices);
    return vertices;
}

/// The entities of a list, findable by their vertices: bucketed by the smallest vertex.
template <class I, std::size_t N>
class Buckets {
public:
    Buckets(const IndexVector<I, std::array<VertexIndex, N>>& list, std::size_t vertex_count)
        : list_(&list), bucket_begin_(vertex_count + 1, 0), members_(list.size()) {
        for (const auto& vertices : list) ++bucket_begin_[smallest(vertices)];
        std::exclusive_scan(bucket_begin_.begin(), bucket_begin_.end(), bucket_begin_.begin(), 0U);
        auto next = bucket_begin_;
        for (I i{0}; i < list.end_index(); ++i) members_[next[smallest(list[i])]++] = i;
    }

    /// Calls found(i) for each entity of the list with these vertices, in whatever order.
    void find(const std::array<VertexIndex, N>& vertices, auto&& found) const {
        const std::uint32_t bucket = smallest(vertices);
        for (auto k = bucket_begin_[bucket]; k < bucket_begin_[bucket + 1]; ++k) {
            if (sorted((*list_)[members_[k]]) == sorted(vertices)) found(members_[k]);
        }
    }

private:
    static std::uint32_t smallest(const std::array<VertexIndex, N>& vertices) {
        return std::ranges::min(vertices).value();
    }

    const IndexVector<I, std::array<VertexIndex, N>>* list_;
    std::vector<std::uint32_t> bucket_begin_;
    std::vector<I> members_;
};

/// The first of the list that no cell has among its `sides` (faces or edges).
template <class I, std::size_t N, std::size_t Sides>
I find_stray(const Mesh& mesh, const IndexVector<I, std::array<VertexIndex, N>>& list,
             const std::array<std::array<std::uint8_t, N>, Sides>& sides) {
    if (list.empty()) return I::none();
    const Buckets<I, N> buckets(list, mesh.points.size());
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
