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
class Whole {
public:
    Whole(const std::array<VertexIndex, N>& piece, const VertexLevels& levels,
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

/// Removes repeated entries of `wholes`, which are given with their positions in the list; the
/// first of each is kept.
template <class Vertices>
std::vector<Vertices> each_once(const std::vector<Vertices>& list,
                                std::vector<std::pair<Vertices, std::size_t>> wholes) {
    std::ranges::sort(wholes);
    std::vector<bool> is_again(list.size(), false);
    for (std::size_t k = 1; k < wholes.size(); ++k) {
        is_again[wholes[k].second] = wholes[k].first == wholes[k - 1].first;
    }
    std::vector<Vertices> result;
    for (std::size_t k = 0; k < list.size(); ++k) {
        if (!is_again[k]) result.push_back(list[k]);
    }
    return result;
}

template <std::size_t N>
std::vector<std::array<VertexIndex, N>> coarser(const std::vector<std::array<VertexIndex, N>>& list,
                                                const VertexLevels& levels,
                                                const KeptVertices& kept) {
    std::vector<std::array<VertexIndex, N>> result;
    std::vector<std::pair<std::array<VertexIndex, N>, std::size_t>> wholes;
    for (const auto& piece : list) {
        if (std::ranges::all_of(piece, [&](VertexIndex v) { return kept[v] != 0; })) {
            result.push_back(piece);
            continue;
        }
        const Whole<N> whole(piece, levels, kept);
        if (!whole.exists()) continue;
        wholes.emplace_back(whole.vertices(), result.size());
        result.push_back(whole.vertices());
    }
    return wholes.empty() ? result : each_once(result, std::move(wholes));
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
