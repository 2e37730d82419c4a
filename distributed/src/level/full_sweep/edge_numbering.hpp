#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "level/full_sweep/first_of_sixteen.hpp"

namespace octetra::distributed {

/// Numbers the edges of a set of cells without sorting all of them. Each edge is stored with its
/// end of lower number; the star of that vertex lists the other ends, and edges are numbered star
/// by star. If the set is not all cells, one additional number, the last, denotes all other edges.
///
/// Memory: 4 bytes per vertex and edge, and 24 per cell; if the set is not all cells, 28 per cell
/// of the set and 4 per cell. During construction, 68 bytes more per vertex, and 68 for each
/// further sixteen edges of one vertex.
class EdgeNumbering {
public:
    EdgeNumbering() = default;

    /// Numbers the edges of all cells. Throws std::length_error if there are more edges than 32-bit
    /// numbers can represent.
    EdgeNumbering(std::size_t vertex_count, const IndexVector<CellIndex, CellVertices>& cells);

    /// Numbers the edges of the cells listed in `of`, each once, of a larger mesh. Throws the same.
    EdgeNumbering(std::size_t vertex_count, const IndexVector<CellIndex, CellVertices>& cells,
                  std::vector<CellIndex> of);

    /// The end of the edge numbers, including the one that denotes other edges, if any.
    [[nodiscard]] EdgeIndex end_index() const {
        return EdgeIndex{std::size_t{begin_.back()} + (has_all() ? 0U : 1U)};
    }

    /// The cells of the set, in the order of the list.
    [[nodiscard]] std::size_t cell_count() const { return has_all() ? rows_.size() : of_.size(); }
    [[nodiscard]] CellIndex cell_at(std::size_t k) const {
        return has_all() ? CellIndex{k} : of_[k];
    }

    /// The edges of a cell, in the order of cell_edges. For a cell outside the set, all six are the
    /// number that denotes other edges.
    [[nodiscard]] const std::array<EdgeIndex, 6>& edges_of(CellIndex cell) const {
        return rows_[has_all() ? cell.value() : cell_to_row_[cell]];
    }

    /// Returns the edge between two vertices. If it has no number of its own, returns the one that
    /// denotes other edges, or none() if the set is all cells.
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

    /// The end of the vertex numbers.
    [[nodiscard]] VertexIndex vertex_end() const { return VertexIndex{begin_.size() - 1}; }

    /// The edges whose lower end is `low` are begin_of(low) .. end_of(low)-1, in unspecified order.
    [[nodiscard]] EdgeIndex begin_of(VertexIndex low) const {
        return EdgeIndex{begin_[low.value()]};
    }
    [[nodiscard]] EdgeIndex end_of(VertexIndex low) const {
        return EdgeIndex{begin_[low.value() + 1U]};
    }
    [[nodiscard]] VertexIndex high_end(EdgeIndex edge) const { return high_end_[edge.value()]; }

private:
    static constexpr std::uint32_t in_bucket = 16;
    /// The number of edges of a star that are searched linearly; further ones are in hub_edges_.
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
    void find_positions(std::size_t cell_count, const auto& cell_at, Buckets& buckets);
    [[nodiscard]] std::uint32_t find_overflow_position(VertexIndex low, VertexIndex high,
                                                       Buckets& buckets);
    void compact(const Buckets& buckets);

    std::vector<std::uint32_t> begin_;
    std::vector<VertexIndex> high_end_;  ///< followed by `read_beyond` more elements
    std::vector<CellIndex> of_;          ///< empty if the set is all cells
    /// The edges of each cell of the set, followed by a row for cells outside the set, if there are
    /// any.
    std::vector<std::array<EdgeIndex, 6>> rows_;
    IndexVector<CellIndex, std::uint32_t> cell_to_row_;  ///< empty if the set is all cells
    /// Position in the star, at least `searched`.
    std::unordered_map<std::uint64_t, std::uint32_t> hub_edges_;
};

}  // namespace octetra::distributed
