#include "dense_closure.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace octetra::distributed {

DenseClosure::DenseClosure(NearEdges& edges, CellOrders& orders,
                           const std::vector<Interface>& interfaces)
    : edges_(&edges), orders_(&orders), interfaces_(&interfaces), outboxes_(interfaces.size()) {
    make_marks();
}

/// For the edges as they are numbered; none is selected.
void DenseClosure::make_marks() {
    const std::size_t edge_count = stars_->end_index().value();
    selected_.assign(edge_count, 0);
    selected_count_ = 0;
    shared_.assign(interfaces_->empty() ? 0 : edge_count, 0);
    shared_edges_.clear();
    interface_edges_.assign(interfaces_->size(), {});
    for (std::size_t i = 0; i < interfaces_->size(); ++i) {
        for (const auto& [a, b] : (*interfaces_)[i].edges) {
            const EdgeIndex edge = stars_->find(a, b);
            shared_edges_.push_back({edge, static_cast<std::uint32_t>(i),
                                     static_cast<std::uint32_t>(interface_edges_[i].size())});
            interface_edges_[i].push_back(edge);
            shared_[edge] = 1;
        }
    }
    std::ranges::sort(shared_edges_, {}, &SharedEdge::edge);
}

void DenseClosure::select_all() {
    for (EdgeIndex edge{0}; edge < selected_.end_index(); ++edge) selected_[edge] = 1;
    selected_count_ = selected_.size();
}

void DenseClosure::select(EdgeIndex edge) {
    if (selected_[edge] != 0) return;
    mark(edge);
    tell_sharers(edge);
}

// Who told has told all that share the edge.
void DenseClosure::select_from(std::size_t interface, std::uint32_t position) {
    const EdgeIndex edge = interface_edges_[interface][position];
    if (selected_[edge] == 0) mark(edge);
}

void DenseClosure::mark(EdgeIndex edge) {
    selected_[edge] = 1;
    ++selected_count_;
    // Before the first sweep every cell is yet to be looked at.
    if (sweep_count_ > 0) queue_.push_back(edge);
}

void DenseClosure::tell_sharers(EdgeIndex edge) {
    if (shared_.empty() || shared_[edge] == 0) return;
    auto shared = std::ranges::lower_bound(shared_edges_, edge, {}, &SharedEdge::edge);
    for (; shared != shared_edges_.end() && shared->edge == edge; ++shared) {
        outboxes_[shared->interface].push_back(shared->position);
    }
}

EdgeMask DenseClosure::selected_of(CellIndex cell) const {
    const auto& edges = stars_->edges_of(cell);
    unsigned mask = 0;
    for (std::size_t e = 0; e < 6; ++e) mask |= static_cast<unsigned>(selected_[edges[e]]) << e;
    return static_cast<EdgeMask>(mask);
}

void DenseClosure::close(CellIndex cell) {
    const EdgeMask mask = selected_of(cell);
    if (is_all_or_none(mask)) return;
    const auto missing =
        static_cast<EdgeMask>(table_->closure(orders_->of(cell), mask) & ~unsigned{mask});
    for (std::size_t e = 0; missing >> e != 0; ++e) {
        if ((missing >> e & 1U) == 0) continue;
        select(stars_->edges_of(cell)[e]);
        leads_beyond_ = leads_beyond_ || !edges_->is_surrounded(cell, e);
    }
}

void DenseClosure::drain() {
    drain_near();
    while (leads_beyond_) {
        widen();
        drain_near();
    }
}

/// Begins anew with more edges; what was selected stays selected, and was told to those who share
/// it.
void DenseClosure::widen() {
    const std::vector<EdgeVertices> selected = ends_of_selected();
    // All that goes by the old numbers goes before the new ones need memory.
    selected_ = {};
    shared_ = {};
    cells_begin_ = {};
    cells_ = {};
    queue_.clear();
    edges_->widen();
    make_marks();
    leads_beyond_ = false;
    sweep_count_ = 0;
    for (const auto& [a, b] : selected) mark(stars_->find(a, b));
}

std::vector<EdgeVertices> DenseClosure::ends_of_selected() const {
    std::vector<EdgeVertices> ends;
    ends.reserve(selected_count_);
    for (VertexIndex low{0}; low < stars_->vertex_end(); ++low) {
        for (EdgeIndex e = stars_->begin_of(low); e < stars_->end_of(low); ++e) {
            if (is_selected(e)) ends.push_back({low, stars_->high_end(e)});
        }
    }
    return ends;
}

// To know the cells at each edge takes as long as several sweeps. Most often they are enough, as
// every other one goes backwards; but a path may turn round as often as it likes.
void DenseClosure::drain_near() {
    constexpr int most_sweeps = 8;
    if (sweep_count_ == 0 && selected_count_ < selected_.size()) sweep();
    while (!queue_.empty() && sweep_count_ < most_sweeps && !leads_beyond_) sweep();
    if (queue_.empty() || leads_beyond_) return;
    if (cells_begin_.empty()) index_cells_at_edges();
    while (!queue_.empty() && !leads_beyond_) {
        const EdgeIndex edge = queue_.back();
        queue_.pop_back();
        for (auto k = cells_begin_[edge.value()]; k < cells_begin_[edge.value() + 1]; ++k) {
            close(cells_[k]);
        }
    }
}

/// Closes every cell that has edges; what is selected meanwhile may concern cells that were passed
/// already.
void DenseClosure::sweep() {
    queue_.clear();
    const bool backwards = sweep_count_++ % 2 != 0;
    const std::size_t count = stars_->cell_count();
    for (std::size_t k = 0; k < count; ++k) close(stars_->cell_at(backwards ? count - 1 - k : k));
}

void DenseClosure::index_cells_at_edges() {
    cells_begin_.assign(std::size_t{stars_->end_index().value()} + 1, 0);
    for (std::size_t k = 0; k < stars_->cell_count(); ++k) {
        for (const EdgeIndex e : stars_->edges_of(stars_->cell_at(k))) ++cells_begin_[e.value()];
    }
    std::exclusive_scan(cells_begin_.begin(), cells_begin_.end(), cells_begin_.begin(), 0U);
    cells_.resize(cells_begin_.back());
    // Filling moves each beginning to its end, which is the next one's beginning ...
    for (std::size_t k = 0; k < stars_->cell_count(); ++k) {
        const CellIndex c = stars_->cell_at(k);
        for (const EdgeIndex e : stars_->edges_of(c)) cells_[cells_begin_[e.value()]++] = c;
    }
    // ... so all of them move on by one place.
    std::shift_right(cells_begin_.begin(), cells_begin_.end(), 1);
    cells_begin_.front() = 0;
}

std::vector<std::vector<std::uint32_t>> DenseClosure::take_outboxes() {
    return std::exchange(outboxes_, std::vector<std::vector<std::uint32_t>>(outboxes_.size()));
}

}  // namespace octetra::distributed
