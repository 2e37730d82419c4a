#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "first_of_sixteen.hpp"

namespace octetra::distributed {

/// Numbers the edges of a set of cells without sorting them all. Every edge belongs to its end
/// point with the lower number; that vertex's star lists the other ends, and the stars follow each
/// other.
///
/// Memory: 4 bytes per vertex and edge, 24 per cell; while it is made 68 per vertex more, and 68
/// for each further sixteen edges of one vertex.
class EdgeStars {
public:
    /// Throws std::length_error if there are more edges than 32 bits number.
    EdgeStars(std::size_t vertex_count, const IndexVector<CellIndex, CellVertices>& cells);

    /// As many as there are edges.
    [[nodiscard]] EdgeIndex end_index() const { return EdgeIndex{begin_.back()}; }

    /// The edges of a cell, in the order of cell_edges.
    [[nodiscard]] const std::array<EdgeIndex, 6>& edges_of(CellIndex cell) const {
        return cell_to_edges_[cell];
    }

    /// The edge between two vertices, or none().
    [[nodiscard]] EdgeIndex find(VertexIndex a, VertexIndex b) const {
        const VertexIndex low = std::min(a, b);
        const VertexIndex high = std::max(a, b);
        const std::uint32_t begin = begin_[low.value()];
        const std::uint32_t end = begin_[low.value() + 1U];
        const std::uint32_t stop = std::min(end, begin + searched);
        for (std::uint32_t edge = begin; edge < stop; edge += in_bucket) {
            const std::uint32_t place = first_of_sixteen(high_end_.data() + edge, high);
            if (place < in_bucket && edge + place < stop) return EdgeIndex{edge + place};
        }
        if (stop == end) return EdgeIndex::none();
        const auto hub_edge = hub_edges_.find(key(low, high));
        return hub_edge == hub_edges_.end() ? EdgeIndex::none()
                                            : EdgeIndex{begin + hub_edge->second};
    }

    /// The edges whose lower end is `low` are begin_of(low) .. end_of(low)-1, in no order.
    [[nodiscard]] EdgeIndex begin_of(VertexIndex low) const {
        return EdgeIndex{begin_[low.value()]};
    }
    [[nodiscard]] EdgeIndex end_of(VertexIndex low) const {
        return EdgeIndex{begin_[low.value() + 1U]};
    }
    [[nodiscard]] VertexIndex high_end(EdgeIndex edge) const { return high_end_[edge.value()]; }

private:
    static constexpr std::uint32_t in_bucket = 16;
    /// Of a star so many edges are searched; further ones are in hub_edges_.
    static constexpr std::uint32_t searched = 4 * in_bucket;
    static constexpr std::size_t read_beyond = in_bucket;
    struct Buckets;

    static std::uint64_t key(VertexIndex low, VertexIndex high) {
        return std::uint64_t{low.value()} << 32U | high.value();
    }
    void find_places(const IndexVector<CellIndex, CellVertices>& cells, Buckets& buckets);
    [[nodiscard]] std::uint32_t find_further_place(VertexIndex low, VertexIndex high,
                                                   Buckets& buckets);
    void move_together(const Buckets& buckets);

    std::vector<std::uint32_t> begin_;
    std::vector<VertexIndex> high_end_;  ///< and `read_beyond` more
    IndexVector<CellIndex, std::array<EdgeIndex, 6>> cell_to_edges_;
    /// The place in the star, `searched` or more.
    std::unordered_map<std::uint64_t, std::uint32_t> hub_edges_;
};

}  // namespace octetra::distributed
