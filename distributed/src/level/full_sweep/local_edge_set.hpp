#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/full_sweep/edge_numbering.hpp"
#include "mark/marked_cells.hpp"

namespace octetra::distributed {

/// Numbers the edges that one level may mark. Most propagation paths end close to the marked
/// cells, so that, if these are not most cells anyway, only the edges of the cells that have a near
/// vertex are numbered: one of a marked cell, one within two edges of such, or one of a shared
/// edge. A path that leads further is noticed at its first edge whose ends are both beyond, as then
/// there may be cells around it whose edges have no number; and widen() goes further, too.
///
/// Keeps a pointer to the mesh, which must stay as it is while edges are still marked. Memory,
/// beyond that of the numbering: a byte per vertex, and another meanwhile.
class LocalEdgeSet {
public:
    /// See Tuning::local_below.
    LocalEdgeSet(const DistributedMesh& mesh, const MarkedCells& marked, double local_below);

    /// Stays where it is, but numbers otherwise after widen().
    [[nodiscard]] const EdgeNumbering& numbering() const { return numbering_; }

    /// Is it certain that all cells around this edge of a cell's, by its place in cell_edges, have
    /// edges of their own?
    [[nodiscard]] bool is_surrounded(CellIndex cell, std::size_t edge) const {
        if (is_near_.empty()) return true;
        const auto& [a, b] = cell_edges[edge];
        const CellVertices& vertices = mesh_->cells[cell];
        return (is_near_[vertices[a]] | is_near_[vertices[b]]) != 0;
    }

    /// Takes in vertices twice as far away the first time, and all the second, or if it comes to
    /// many: each time costs a numbering, and nobody knows how far a path will lead.
    void widen();

private:
    void number(double most);
    void add_ring();
    [[nodiscard]] std::optional<std::vector<CellIndex>> near_cells(double most) const;
    [[nodiscard]] bool is_near(const CellVertices& cell) const {
        const auto& [a, b, c, d] = cell;
        return (is_near_[a] | is_near_[b] | is_near_[c] | is_near_[d]) != 0;
    }

    const DistributedMesh* mesh_;
    double local_below_;
    IndexVector<VertexIndex, std::uint8_t> is_near_;  ///< empty if all are
    bool is_wider_ = false;
    EdgeNumbering numbering_;
};

}  // namespace octetra::distributed
