#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "cell_orders.hpp"
#include "closure.hpp"
#include "near_edges.hpp"
#include "patterns.hpp"

namespace octetra::distributed {

/// With a mark for every edge that has a number; goes through all cells, as often as there is
/// something to find, and then from edge to edge. Where a path leads further, widens what is
/// numbered.
class DenseClosure final : public Closure {
public:
    /// Keeps pointers to all of them.
    DenseClosure(NearEdges& edges, CellOrders& orders, const std::vector<Interface>& interfaces);

    /// Every edge, all of which have numbers, as all processes do then: nobody is told.
    void select_all();

    /// Selects an edge of this process's own will, without following its path. All that share the
    /// edge will be told.
    void select(EdgeIndex edge);
    void select_from(std::size_t interface, std::uint32_t position) override;
    void drain() override;

    [[nodiscard]] bool is_selected(EdgeIndex edge) const { return selected_[edge] != 0; }
    [[nodiscard]] bool all_selected() const { return selected_count_ == selected_.size(); }
    [[nodiscard]] EdgeMask selected_of(CellIndex cell) const;
    [[nodiscard]] std::size_t selected_count() const override { return selected_count_; }
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> take_outboxes() override;

private:
    struct SharedEdge {
        EdgeIndex edge;
        std::uint32_t interface = 0;
        std::uint32_t position = 0;
    };

    void make_marks();
    void mark(EdgeIndex edge);
    void tell_sharers(EdgeIndex edge);
    void close(CellIndex cell);
    void drain_near();
    void widen();
    [[nodiscard]] std::vector<EdgeVertices> ends_of_selected() const;
    void sweep();
    void index_cells_at_edges();

    NearEdges* edges_;
    const EdgeStars* stars_ = &edges_->stars();
    CellOrders* orders_;
    const std::vector<Interface>* interfaces_;
    const PatternTable* table_ = &PatternTable::get();
    IndexVector<EdgeIndex, std::uint8_t> selected_;
    IndexVector<EdgeIndex, std::uint8_t> shared_;  // empty if no edge is
    std::vector<SharedEdge> shared_edges_;         // ascending by edge
    std::vector<std::vector<EdgeIndex>> interface_edges_;
    std::vector<std::vector<std::uint32_t>> outboxes_;
    std::vector<EdgeIndex> queue_;
    std::size_t selected_count_ = 0;
    int sweep_count_ = 0;
    bool leads_beyond_ = false;  ///< an edge is selected around which not all cells have edges
    // The cells at edge e are cells_[cells_begin_[e]] .. cells_[cells_begin_[e + 1] - 1].
    std::vector<std::uint32_t> cells_begin_;
    std::vector<CellIndex> cells_;
};

}  // namespace octetra::distributed
