#include "coarsen/coarser_interfaces.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace octetra::distributed {
namespace {

/// The coarse edge or face that contains one with removed vertices: these are replaced by the ends
/// of their edges. There is none if that results in too many vertices: an edge between children of
/// a face is not part of a coarse edge.
template <std::size_t N>
class CoarseEntity {
public:
    CoarseEntity(const std::array<VertexIndex, N>& piece, const VertexLevels& levels,
                 const KeptVertices& kept) {
        for (const VertexIndex v : piece) {
            if (kept[v] != 0) {
                add(v);
            } else {
                for (const VertexIndex end : levels.ends(v)) add(end);
            }
        }
        std::ranges::sort(corners_);
    }

    [[nodiscard]] bool exists() const { return count_ == N; }
    /// Vertices in ascending order: the same order on both ranks.
    [[nodiscard]] std::array<VertexIndex, N> vertices() const {
        std::array<VertexIndex, N> vertices;
        std::copy_n(corners_.begin(), N, vertices.begin());
        return vertices;
    }

private:
    void add(VertexIndex v) {
        if (std::ranges::find(corners_, v) == corners_.end()) corners_[count_++] = v;
    }

    std::array<VertexIndex, 2 * N> corners_;  ///< none() after the last
    std::size_t count_ = 0;
};

/// Removes repeated entries of `coarse_entities`, which are given with their positions in the list;
/// the first of each is kept.
template <class Vertices>
std::vector<Vertices> without_duplicates(
    const std::vector<Vertices>& list,
    std::vector<std::pair<Vertices, std::size_t>> coarse_entities) {
    std::ranges::sort(coarse_entities);
    std::vector<bool> is_duplicate(list.size(), false);
    for (std::size_t k = 1; k < coarse_entities.size(); ++k) {
        is_duplicate[coarse_entities[k].second] =
            coarse_entities[k].first == coarse_entities[k - 1].first;
    }
    std::vector<Vertices> result;
    for (std::size_t k = 0; k < list.size(); ++k) {
        if (!is_duplicate[k]) result.push_back(list[k]);
    }
    return result;
}

template <std::size_t N>
std::vector<std::array<VertexIndex, N>> coarser(const std::vector<std::array<VertexIndex, N>>& list,
                                                const VertexLevels& levels,
                                                const KeptVertices& kept) {
    std::vector<std::array<VertexIndex, N>> result;
    std::vector<std::pair<std::array<VertexIndex, N>, std::size_t>> coarse_entities;
    for (const auto& piece : list) {
        if (std::ranges::all_of(piece, [&](VertexIndex v) { return kept[v] != 0; })) {
            result.push_back(piece);
            continue;
        }
        const CoarseEntity<N> whole(piece, levels, kept);
        if (!whole.exists()) continue;
        coarse_entities.emplace_back(whole.vertices(), result.size());
        result.push_back(whole.vertices());
    }
    return coarse_entities.empty() ? result
                                   : without_duplicates(result, std::move(coarse_entities));
}

}  // namespace

std::vector<Interface> coarser_interfaces(const std::vector<Interface>& interfaces,
                                          const VertexLevels& levels, const KeptVertices& kept) {
    std::vector<Interface> result;
    for (const Interface& interface : interfaces) {
        result.push_back({interface.rank, coarser(interface.edges, levels, kept),
                          coarser(interface.faces, levels, kept)});
    }
    return result;
}

}  // namespace octetra::distributed
