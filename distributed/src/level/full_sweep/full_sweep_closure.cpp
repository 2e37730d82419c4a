#include "level/full_sweep/full_sweep_closure.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace octetra::distributed {

FullSweepClosure::FullSweepClosure(LocalEdgeSet& edges, CellOrders& orders,
                                   const std::vector<Interface>& interfaces,
                                   const TransitionCells* transition)
    : edges_(&edges),
      orders_(&orders),
      interfaces_(&interfaces),
      transition_(transition),
      outboxes_(interfaces.size()) {
    make_marks();
}

/// Creates unset marks for the current numbering.
void FullSweepClosure::make_marks() {
    const std::size_t edge_count = numbering_->end_index().value();
    marked_.assign(edge_count, 0);
    marked_count_ = 0;
    shared_.assign(interfaces_->empty() ? 0 : edge_count, 0);
    shared_edges_.clear();
    interface_edges_.assign(interfaces_->size(), {});
    for (std::size_t i = 0; i < interfaces_->size(); ++i) {
        for (const auto& [a, b] : (*interfaces_)[i].edges) {
            const EdgeIndex edge = numbering_->find(a, b);
            shared_edges_.push_back({edge, static_cast<std::uint32_t>(i),
                                     static_cast<std::uint32_t>(interface_edges_[i].size())});
            interface_edges_[i].push_back(edge);
            shared_[edge] = 1;
        }
    }
    std::ranges::sort(shared_edges_, {}, &SharedEdge::edge);
}

void FullSweepClosure::mark_all() {
    for (EdgeIndex edge{0}; edge < marked_.end_index(); ++edge) marked_[edge] = 1;
    marked_count_ = marked_.size();
}

void FullSweepClosure::mark(EdgeIndex edge) {
    if (marked_[edge] != 0) return;
    set_mark(edge);
    notify_sharers(edge);
}

// The sender notifies every sharer of the edge.
void FullSweepClosure::mark_from(std::size_t interface, std::uint32_t position) {
    const EdgeIndex edge = interface_edges_[interface][position];
    if (marked_[edge] == 0) set_mark(edge);
}

void FullSweepClosure::set_mark(EdgeIndex edge) {
    marked_[edge] = 1;
    ++marked_count_;
    // The first sweep closes every cell anyway.
    if (sweep_count_ > 0) queue_.push_back(edge);
}

void FullSweepClosure::notify_sharers(EdgeIndex edge) {
    if (shared_.empty() || shared_[edge] == 0) return;
    auto shared = std::ranges::lower_bound(shared_edges_, edge, {}, &SharedEdge::edge);
    for (; shared != shared_edges_.end() && shared->edge == edge; ++shared) {
        outboxes_[shared->interface].push_back(shared->position);
    }
}

EdgeMask FullSweepClosure::marked_of(CellIndex cell) const {
    const auto& edges = numbering_->edges_of(cell);
    unsigned mask = 0;
    for (std::size_t e = 0; e < 6; ++e) mask |= static_cast<unsigned>(marked_[edges[e]]) << e;
    return static_cast<EdgeMask>(mask);
}

void FullSweepClosure::close(CellIndex cell) {
    const EdgeMask mask = marked_of(cell);
    if (transition_ != nullptr && transition_->contains(cell)) {
        if (mask != 0) {
            transition_->close(cell, mask, [&](CellIndex c, EdgeMask edges) { mark(c, edges); });
        }
    } else if (!is_all_or_none(mask)) {
        mark(cell, table_->closure(orders_->of(cell), mask));
    }
}

/// Marks edges of a cell.
void FullSweepClosure::mark(CellIndex cell, EdgeMask edges) {
    const auto missing = static_cast<EdgeMask>(edges & ~unsigned{marked_of(cell)});
    for (std::size_t e = 0; missing >> e != 0; ++e) {
        if ((missing >> e & 1U) == 0) continue;
        mark(numbering_->edges_of(cell)[e]);
        leaves_local_set_ = leaves_local_set_ || !edges_->is_surrounded(cell, e);
    }
}

void FullSweepClosure::drain() {
    drain_near();
    while (leaves_local_set_) {
        widen();
        drain_near();
    }
}

/// Restarts with a larger edge set. Marked edges stay marked, and their sharers have been notified.
void FullSweepClosure::widen() {
    const std::vector<EdgeVertices> marked = ends_of_marked();
    // Frees everything that uses the old numbers before the new numbering needs memory.
    marked_ = {};
    shared_ = {};
    cells_begin_ = {};
    cells_ = {};
    queue_.clear();
    edges_->widen();
    make_marks();
    leaves_local_set_ = false;
    sweep_count_ = 0;
    for (const auto& [a, b] : marked) set_mark(numbering_->find(a, b));
}

std::vector<EdgeVertices> FullSweepClosure::ends_of_marked() const {
    std::vector<EdgeVertices> ends;
    ends.reserve(marked_count_);
    for (VertexIndex low{0}; low < numbering_->vertex_end(); ++low) {
        for (EdgeIndex e = numbering_->begin_of(low); e < numbering_->end_of(low); ++e) {
            if (is_marked(e)) ends.push_back({low, numbering_->high_end(e)});
        }
    }
    return ends;
}

// To compute the cells at each edge takes as long as several sweeps. Usually a few sweeps suffice,
// since their direction alternates; but a path may change its direction arbitrarily often.
void FullSweepClosure::drain_near() {
    constexpr int max_sweeps = 8;
    if (sweep_count_ == 0 && marked_count_ < marked_.size()) sweep();
    while (!queue_.empty() && sweep_count_ < max_sweeps && !leaves_local_set_) sweep();
    if (queue_.empty() || leaves_local_set_) return;
    if (cells_begin_.empty()) index_cells_at_edges();
    while (!queue_.empty() && !leaves_local_set_) {
        const EdgeIndex edge = queue_.back();
        queue_.pop_back();
        for (auto k = cells_begin_[edge.value()]; k < cells_begin_[edge.value() + 1]; ++k) {
            close(cells_[k]);
        }
    }
}

/// Closes every cell with numbered edges; its marks may affect cells that were processed before.
void FullSweepClosure::sweep() {
    queue_.clear();
    const bool backwards = sweep_count_++ % 2 != 0;
    const std::size_t count = numbering_->cell_count();
    for (std::size_t k = 0; k < count; ++k)
        close(numbering_->cell_at(backwards ? count - 1 - k : k));
}

void FullSweepClosure::index_cells_at_edges() {
    cells_begin_.assign(std::size_t{numbering_->end_index().value()} + 1, 0);
    for (std::size_t k = 0; k < numbering_->cell_count(); ++k) {
        for (const EdgeIndex e : numbering_->edges_of(numbering_->cell_at(k)))
            ++cells_begin_[e.value()];
    }
    std::exclusive_scan(cells_begin_.begin(), cells_begin_.end(), cells_begin_.begin(), 0U);
    cells_.resize(cells_begin_.back());
    // Filling advances each offset to the end of its range, which is the next offset ...
    for (std::size_t k = 0; k < numbering_->cell_count(); ++k) {
        const CellIndex c = numbering_->cell_at(k);
        for (const EdgeIndex e : numbering_->edges_of(c)) cells_[cells_begin_[e.value()]++] = c;
    }
    // ... so all offsets are shifted by one position.
    std::shift_right(cells_begin_.begin(), cells_begin_.end(), 1);
    cells_begin_.front() = 0;
}

std::vector<std::vector<std::uint32_t>> FullSweepClosure::take_outboxes() {
    return std::exchange(outboxes_, std::vector<std::vector<std::uint32_t>>(outboxes_.size()));
}

}  // namespace octetra::distributed
