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

/// The entities of a list, findable by their vertices: bucketed by the smallest vertex, and sorted
/// within a bucket, because thousands may meet at the hub of a fan.
template <class I, std::size_t N>
class Buckets {
    using Vertices = std::array<VertexIndex, N>;

public:
    Buckets(const IndexVector<I, Vertices>& list, std::size_t vertex_count)
        : list_(&list), bucket_begin_(vertex_count + 1, 0), members_(list.size()) {
        for (const Vertices& vertices : list) ++bucket_begin_[smallest(vertices)];
        std::exclusive_scan(bucket_begin_.begin(), bucket_begin_.end(), bucket_begin_.begin(), 0U);
        auto next = bucket_begin_;
        for (I i{0}; i < list.end_index(); ++i) members_[next[smallest(list[i])]++] = i;
        for (std::size_t bucket = 0; bucket < vertex_count; ++bucket) {
            std::sort(begin_of(bucket), begin_of(bucket + 1),
                      [&](I i, I j) { return sorted(list[i]) < sorted(list[j]); });
        }
    }

    /// One entity of the list with these vertices, in whatever order, and always the same one;
    /// none() if there is no such entity.
    [[nodiscard]] I find(const Vertices& vertices) const {
        const Vertices wanted = sorted(vertices);
        const auto first = members_.begin() + bucket_begin_[wanted.front().value()];
        const auto last = members_.begin() + bucket_begin_[wanted.front().value() + 1];
        const auto found = std::lower_bound(first, last, wanted, [&](I i, const Vertices& other) {
            return sorted((*list_)[i]) < other;
        });
        return found != last && sorted((*list_)[*found]) == wanted ? *found : I::none();
    }

private:
    static std::uint32_t smallest(const Vertices& vertices) {
        return std::ranges::min(vertices).value();
    }
    auto begin_of(std::size_t bucket) { return members_.begin() + bucket_begin_[bucket]; }

    const IndexVector<I, Vertices>* list_;
    std::vector<std::uint32_t> bucket_begin_;
    std::vector<I> members_;
};

/// The first of the list that no cell has among its `sides` (faces or edges).
template <class I, std::size_t N, std::size_t Sides>
I find_stray(const Mesh& mesh, const IndexVector<I, std::array<VertexIndex, N>>& list,
             const std::array<std::array<std::uint8_t, N>, Sides>& sides) {
    if (list.empty()) return I::none();
    const Buckets<I, N> buckets(list, mesh.points.size());
    // Of an entity that is listed twice, only the one that is found counts as met.
    std::vector<bool> met(list.size(), false);
    for (const CellVertices& cell : mesh.cells) {
        for (const auto& side : sides) {
            std::array<VertexIndex, N> vertices;
            for (std::size_t k = 0; k < N; ++k) vertices[k] = cell[side[k]];
            if (const I i = buckets.find(vertices); !i.is_none()) met[i.value()] = true;
        }
    }
    for (I i{0}; i < list.end_index(); ++i) {
        if (!met[buckets.find(list[i]).value()]) return i;
    }
    return I::none();
}

}  // namespace

FacetIndex find_stray_facet(const Mesh& mesh) { return find_stray(mesh, mesh.facets, cell_faces); }

EdgeIndex find_stray_edge(const Mesh& mesh) { return find_stray(mesh, mesh.edges, cell_edges); }

}  // namespace octetra
