#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/full_sweep/local_edge_set.hpp"
#include "level/marked_edges.hpp"
#include "level/transition_cells.hpp"
#include "pattern/cell_orders.hpp"
#include "pattern/patterns.hpp"

namespace octetra::distributed {

/// Closure with a mark for every numbered edge: sweeps over all cells repeatedly while there are
/// unclosed ones, and then continues from edge to edge. Extends the local edge set if a path leaves
/// it.
///
/// Sweeps alternate in direction. Under one numbering there are at most eight, each of which leaves
/// about a tenth of the queue. If edges are still queued then, an index of the cells at each edge
/// is built, which costs about as much as six sweeps, and the queue is processed edge by edge.
class FullSweepClosure final : public MarkedEdges {
public:
    /// Keeps references to all arguments. `transition` may be null: there are no such cells.
    /// Otherwise the edges of all cells must be numbered.
    FullSweepClosure(LocalEdgeSet& edges, CellOrders& orders,
                     const std::vector<Interface>& interfaces, const TransitionCells* transition);

    /// Marks every edge, all of which are numbered. All processes must do the same: the sharers are
    /// not notified.
    void mark_all();

    /// Marks an edge without following its path. Its sharers will be notified.
    void mark(EdgeIndex edge);
    void mark_from(std::size_t interface, std::uint32_t position) override;
    void drain() override;

    [[nodiscard]] bool is_marked(EdgeIndex edge) const { return marked_[edge] != 0; }
    [[nodiscard]] bool all_marked() const { return marked_count_ == marked_.size(); }
    [[nodiscard]] EdgeMask marked_of(CellIndex cell) const;
    [[nodiscard]] std::size_t marked_count() const override { return marked_count_; }
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> take_outboxes() override;

private:
    struct SharedEdge {
        EdgeIndex edge;
        std::uint32_t interface = 0;
        std::uint32_t position = 0;
    };

    void make_marks();
    void set_mark(EdgeIndex edge);
    void notify_sharers(EdgeIndex edge);
    void close(CellIndex cell);
    void mark(CellIndex cell, EdgeMask edges);
    void drain_near();
    void widen();
    [[nodiscard]] std::vector<EdgeVertices> ends_of_marked() const;
    void sweep();
    void index_cells_at_edges();

    LocalEdgeSet* edges_;
    const EdgeNumbering* numbering_ = &edges_->numbering();
    CellOrders* orders_;
    const std::vector<Interface>* interfaces_;
    const TransitionCells* transition_;
    const PatternTable* table_ = &PatternTable::get();
    IndexVector<EdgeIndex, std::uint8_t> marked_;
    IndexVector<EdgeIndex, std::uint8_t> shared_;  // empty if no edge is
    std::vector<SharedEdge> shared_edges_;         // ascending by edge
    std::vector<std::vector<EdgeIndex>> interface_edges_;
    std::vector<std::vector<std::uint32_t>> outboxes_;
    std::vector<EdgeIndex> queue_;
    std::size_t marked_count_ = 0;
    int sweep_count_ = 0;
    bool leaves_local_set_ = false;  ///< a marked edge may be in cells without edge numbers
    // The cells with edge e are cells_[cells_begin_[e]] .. cells_[cells_begin_[e + 1] - 1].
    std::vector<std::uint32_t> cells_begin_;
    std::vector<CellIndex> cells_;
};

}  // namespace octetra::distributed
