#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/full_sweep/edge_numbering.hpp"
#include "level/marked_cells.hpp"

namespace octetra::distributed {

/// Numbers the edges that one level may mark. Most propagation paths end close to the marked cells.
/// So, unless most cells are marked, only the edges of cells with a near vertex are numbered: a
/// vertex of a marked cell, a vertex within two edges of those, or an end of a shared edge. A path
/// that leads further is detected at its first edge of which neither end is near, as cells around
/// it may have edges without numbers; widen() then extends the set.
///
/// Keeps a pointer to the mesh, which must not change while edges are being marked. Memory, in
/// addition to the numbering: a byte per vertex, and temporarily another.
class LocalEdgeSet {
public:
    /// For `local_below` see Tuning.
    LocalEdgeSet(const DistributedMesh& mesh, const MarkedCells& marked, double local_below);

    /// The reference stays valid, but widen() changes the numbers.
    [[nodiscard]] const EdgeNumbering& numbering() const { return numbering_; }

    /// Returns whether all cells around this edge of a cell, by its position in cell_edges, are
    /// certain to have numbered edges.
    [[nodiscard]] bool is_surrounded(CellIndex cell, std::size_t edge) const {
        if (is_near_.empty()) return true;
        const auto& [a, b] = cell_edges[edge];
        const CellVertices& vertices = mesh_->cells[cell];
        return (is_near_[vertices[a]] | is_near_[vertices[b]]) != 0;
    }

    /// Extends the set: the first time to vertices twice as far away, the second time, or if the
    /// set becomes too large, to all cells. Each call repeats the numbering, and the length of a
    /// path is unknown.
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
    IndexVector<VertexIndex, std::uint8_t> is_near_;  ///< empty if all vertices are
    bool is_wider_ = false;
    EdgeNumbering numbering_;
};

}  // namespace octetra::distributed
