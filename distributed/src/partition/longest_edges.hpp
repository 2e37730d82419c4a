#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::distributed {

/// The edges that are the longest one of some cell, and the cells of each. These cells are bisected
/// together: a mark on any edge of one of them leads to a mark on the longest edge.
///
/// Edges are numbered from 0, in ascending order of their (lower, higher) end. Keeps a pointer to
/// the mesh's cells. Memory: 12 bytes per edge and 5 per cell.
class LongestEdges {
public:
    explicit LongestEdges(const Mesh& mesh);

    [[nodiscard]] EdgeIndex end_index() const { return ends_.end_index(); }
    [[nodiscard]] std::size_t cell_count() const { return cells_.size(); }

    /// The ends of an edge, the lower one first.
    [[nodiscard]] const EdgeVertices& ends(EdgeIndex edge) const { return ends_[edge]; }

    /// The ends of a cell's longest edge, the lower one first.
    [[nodiscard]] EdgeVertices longest_of(CellIndex c) const {
        const auto& [i, j] = cell_edges[position_[c]];
        const auto [low, high] = std::minmax((*cells_of_mesh_)[c][i], (*cells_of_mesh_)[c][j]);
        return {low, high};
    }

    /// The cells of which this is the longest edge, ascending.
    [[nodiscard]] std::span<const CellIndex> cells_of(EdgeIndex edge) const {
        return {cells_.data() + begin_[edge.value()], cells_.data() + begin_[edge.value() + 1U]};
    }

private:
    const IndexVector<CellIndex, CellVertices>* cells_of_mesh_;
    IndexVector<CellIndex, std::uint8_t> position_;  ///< of the longest edge in cell_edges
    IndexVector<EdgeIndex, EdgeVertices> ends_;
    std::vector<std::uint32_t> begin_;
    std::vector<CellIndex> cells_;
};

}  // namespace octetra::distributed
