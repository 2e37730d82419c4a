#pragma once

#include "cell_orders.hpp"
#include "chosen_cells.hpp"
#include "dense_closure.hpp"
#include "level.hpp"
#include "near_edges.hpp"

namespace octetra::distributed {

/// The way for many chosen cells: numbers edges, and makes all lists anew. Takes time in proportion
/// to the process's part, and least for each cell that it bisects.
class DenseLevel final : public Level {
public:
    /// The mesh must be in order.
    DenseLevel(DistributedMesh& mesh, const ChosenCells& chosen);

    /// Selects edges of the chosen cells, the same as before.
    void select(const ChosenCells& chosen, Scheme scheme);

    [[nodiscard]] Closure& closure() override { return closure_; }
    void bisect_edges() override;
    [[nodiscard]] std::size_t cell_count_afterwards() override;
    [[nodiscard]] RoundingFailure bisect_cells(std::size_t cell_count) override;
    void bisect_listed() override;
    void bisect_interfaces() override;
    [[nodiscard]] std::size_t cells_touched() const override { return orders_.end_index().value(); }

private:
    void select(CellIndex cell, Scheme scheme);

    DistributedMesh* mesh_;
    NearEdges edges_;
    const EdgeStars* stars_ = &edges_.stars();
    CellOrders orders_;
    DenseClosure closure_;
    IndexVector<CellIndex, EdgeMask> selected_;      ///< of each cell, once they are counted
    IndexVector<EdgeIndex, VertexIndex> midpoints_;  ///< of each edge, or none()
};

}  // namespace octetra::distributed
