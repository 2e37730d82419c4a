#include "edge_stars.hpp"

#include "huge_pages.hpp"

namespace octetra::distributed {

/// The higher ends of each vertex's edges, in places 0 to 15 as they are met; each in a line of the
/// cache.
struct EdgeStars::Buckets {
    struct alignas(64) Bucket : std::array<VertexIndex, in_bucket> {};

    explicit Buckets(std::size_t vertex_count) {
        reserve_in_huge_pages(of, vertex_count);
        of.resize(vertex_count);
    }

    IndexVector<VertexIndex, Bucket> of;
    /// For each vertex, so many edges are in its bucket and in hub_edges_; empty before the first
    /// bucket overflows.
    IndexVector<VertexIndex, std::uint32_t> counts;
};

EdgeStars::EdgeStars(std::size_t vertex_count, const IndexVector<CellIndex, CellVertices>& cells) {
    Buckets buckets(vertex_count);
    find_places(cells, buckets);
    move_together(buckets);
    for (CellIndex c{0}; c < cells.end_index(); ++c) {
        for (std::size_t e = 0; e < 6; ++e) {
            const auto& [a, b] = cell_edges[e];
            const VertexIndex low = std::min(cells[c][a], cells[c][b]);
            EdgeIndex& edge = cell_to_edges_[c][e];
            edge = EdgeIndex{std::size_t{begin_[low.value()]} + edge.value()};
        }
    }
}

/// For each edge of each cell its place among the edges of its lower end.
void EdgeStars::find_places(const IndexVector<CellIndex, CellVertices>& cells, Buckets& buckets) {
    constexpr std::size_t ahead = 8;
    reserve_in_huge_pages(cell_to_edges_, cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
        if (c + ahead < cells.size()) {
            for (const VertexIndex v : cells[CellIndex{c + ahead}]) {
                __builtin_prefetch(&buckets.of[v], 1);
            }
        }
        const CellVertices& cell = cells[CellIndex{c}];
        auto& places = cell_to_edges_.emplace_back();
        for (std::size_t e = 0; e < 6; ++e) {
            const VertexIndex a = cell[cell_edges[e][0]];
            const VertexIndex b = cell[cell_edges[e][1]];
            // Without a branch: which one is lower cannot be foreseen.
            const std::uint32_t exchange = (a.value() ^ b.value()) & -std::uint32_t{b < a};
            const VertexIndex low{a.value() ^ exchange};
            const VertexIndex high{b.value() ^ exchange};
            auto& bucket = buckets.of[low];
            std::uint32_t place = first_of_sixteen(bucket.data(), high);
            if (place == in_bucket) {
                place = first_of_sixteen(bucket.data(), VertexIndex::none());
                if (place < in_bucket) {
                    bucket[place] = high;
                } else {
                    place = find_place_at_hub(low, high, buckets);
                }
            }
            places[e] = EdgeIndex{place};
        }
    }
}

std::uint32_t EdgeStars::find_place_at_hub(VertexIndex low, VertexIndex high, Buckets& buckets) {
    if (buckets.counts.empty()) buckets.counts.resize(buckets.of.size(), in_bucket);
    const auto [edge, is_new] = hub_edges_.emplace(key(low, high), buckets.counts[low]);
    if (is_new) ++buckets.counts[low];
    return edge->second;
}

/// Numbers the edges from vertex to vertex.
void EdgeStars::move_together(const Buckets& buckets) {
    std::uint32_t count = 0;
    for (VertexIndex v{0}; v < buckets.of.end_index(); ++v) {
        begin_.push_back(count);
        const std::uint32_t met = first_of_sixteen(buckets.of[v].data(), VertexIndex::none());
        count += met == in_bucket && !buckets.counts.empty() ? buckets.counts[v] : met;
    }
    begin_.push_back(count);

    // A bucket is copied whole: what follows its last edge is overwritten by the next one.
    high_end_.resize(count + read_beyond + 1);
    for (VertexIndex v{0}; v < buckets.of.end_index(); ++v) {
        std::ranges::copy(buckets.of[v], high_end_.begin() + begin_[v.value()]);
    }
    for (const auto& [key, place] : hub_edges_) {
        high_end_[begin_[key >> 32U] + place] = VertexIndex{key & VertexIndex::none_value};
    }
}

}  // namespace octetra::distributed
