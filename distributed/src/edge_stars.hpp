#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <unordered_map>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::distributed {

/// Numbers the edges of a set of cells without sorting them all. Every edge belongs to its end
/// point with the lower number; that vertex's bucket lists the other ends, and the buckets follow
/// each other.
///
/// Memory: 4 bytes per vertex and edge, 24 per cell; 8 per vertex and 24 per cell more while it is
/// made.
class EdgeStars {
public:
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
        const std::uint32_t slot =
            find_slot(low, high, begin_[low.value()], begin_[low.value() + 1U]);
        return slot == begin_[low.value() + 1U] ? EdgeIndex::none() : EdgeIndex{slot};
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
    static constexpr std::uint32_t searched = 64;
    static constexpr std::size_t read_beyond = 7;

    /// Which of the eight is the first that is wanted? 8 or more: none. All at once, as a branch
    /// for each would be foreseen badly.
    static unsigned first_of_eight(const VertexIndex* list, VertexIndex wanted) {
        using Four = std::uint32_t __attribute__((vector_size(16)));
        static_assert(sizeof(VertexIndex) == sizeof(std::uint32_t));
        Four low;
        Four high;
        std::memcpy(&low, list, sizeof(low));
        std::memcpy(&high, list + 4, sizeof(high));
        const auto found = ((low == wanted.value()) & Four{1, 2, 4, 8}) |
                           ((high == wanted.value()) & Four{16, 32, 64, 128});
        const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(found);
        const std::uint64_t both = halves[0] | halves[1];
        return static_cast<unsigned>(std::countr_zero(both | both >> 32U));
    }

    static std::uint64_t key(VertexIndex low, VertexIndex high) {
        return std::uint64_t{low.value()} << 32U | high.value();
    }
    /// The slot of the edge in the bucket begin .. end-1, or the end.
    [[nodiscard]] std::uint32_t find_slot(VertexIndex low, VertexIndex high, std::uint32_t begin,
                                          std::uint32_t end) const {
        const std::uint32_t stop = std::min(end, begin + searched);
        for (std::uint32_t slot = begin; slot < stop; slot += 8) {
            const unsigned first = first_of_eight(high_end_.data() + slot, high);
            if (first < 8 && slot + first < stop) return slot + first;
        }
        if (stop == end) return end;
        const auto hub_edge = hub_edges_.find(key(low, high));
        return hub_edge == hub_edges_.end() ? end : hub_edge->second;
    }
    [[nodiscard]] std::vector<std::uint32_t> fill_buckets(
        const IndexVector<CellIndex, CellVertices>& cells);
    void close_gaps(const std::vector<std::uint32_t>& end,
                    const IndexVector<CellIndex, CellVertices>& cells);

    std::vector<std::uint32_t> begin_;
    std::vector<VertexIndex> high_end_;  ///< and `read_beyond` more
    IndexVector<CellIndex, std::array<EdgeIndex, 6>> cell_to_edges_;
    std::unordered_map<std::uint64_t, std::uint32_t> hub_edges_;
};

}  // namespace octetra::distributed
