#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "level/full_sweep/first_of_sixteen.hpp"

namespace octetra::distributed {

/// Numbers the edges of a set of cells without sorting them all. Every edge belongs to its end
/// point with the lower number; that vertex's star lists the other ends, and the numbering follow
/// each other. If they are told to be some cells', one more number, the last, stands for other
/// edges.
///
/// Memory: 4 bytes per vertex and edge, 24 per cell; or, if there are others, 28 per cell of the
/// set and 4 per cell. While it is made 68 per vertex more, and 68 for each further sixteen edges
/// of one vertex.
class EdgeNumbering {
public:
    EdgeNumbering() = default;

    /// Of all cells. Throws std::length_error if there are more edges than 32 bits number.
    EdgeNumbering(std::size_t vertex_count, const IndexVector<CellIndex, CellVertices>& cells);

    /// Of those listed in `of`, each once, while there may be others. Throws the same.
    EdgeNumbering(std::size_t vertex_count, const IndexVector<CellIndex, CellVertices>& cells,
                  std::vector<CellIndex> of);

    /// As many as there are edges, and one more if there may be others.
    [[nodiscard]] EdgeIndex end_index() const {
        return EdgeIndex{std::size_t{begin_.back()} + (has_all() ? 0U : 1U)};
    }

    /// The cells of the set, in the order in which they were listed.
    [[nodiscard]] std::size_t cell_count() const { return has_all() ? rows_.size() : of_.size(); }
    [[nodiscard]] CellIndex cell_at(std::size_t k) const {
        return has_all() ? CellIndex{k} : of_[k];
    }

    /// The edges of a cell, in the order of cell_edges. Of one that is not of the set all six are
    /// the number that stands for others.
    [[nodiscard]] const std::array<EdgeIndex, 6>& edges_of(CellIndex cell) const {
        return rows_[has_all() ? cell.value() : cell_to_row_[cell]];
    }

    /// The edge between two vertices. If it has no number, the one that stands for others, or
    /// none() if all cells have edges of their own.
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
        if (stop == end) return other();
        const auto hub_edge = hub_edges_.find(key(low, high));
        return hub_edge == hub_edges_.end() ? other() : EdgeIndex{begin + hub_edge->second};
    }

    /// After the last vertex.
    [[nodiscard]] VertexIndex vertex_end() const { return VertexIndex{begin_.size() - 1}; }

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
    [[nodiscard]] bool has_all() const { return cell_to_row_.empty(); }
    [[nodiscard]] EdgeIndex other() const {
        return has_all() ? EdgeIndex::none() : EdgeIndex{begin_.back()};
    }
    void number(std::size_t vertex_count, std::size_t cell_count, const auto& cell_at);
    void find_places(std::size_t cell_count, const auto& cell_at, Buckets& buckets);
    [[nodiscard]] std::uint32_t find_further_place(VertexIndex low, VertexIndex high,
                                                   Buckets& buckets);
    void move_together(const Buckets& buckets);

    std::vector<std::uint32_t> begin_;
    std::vector<VertexIndex> high_end_;  ///< and `read_beyond` more
    std::vector<CellIndex> of_;          ///< empty if the set is all cells
    /// The edges of each cell of the set, and then, if there are other cells, those of all of them.
    std::vector<std::array<EdgeIndex, 6>> rows_;
    IndexVector<CellIndex, std::uint32_t> cell_to_row_;  ///< empty if it is the cell's own number
    /// The place in the star, `searched` or more.
    std::unordered_map<std::uint64_t, std::uint32_t> hub_edges_;
};

}  // namespace octetra::distributed
