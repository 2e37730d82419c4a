#include "dense_closure.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace octetra::distributed {

DenseClosure::DenseClosure(const EdgeStars& stars, CellOrders& orders,
                           const std::vector<Interface>& interfaces)
    : stars_(&stars),
      orders_(&orders),
      selected_(stars.end_index().value(), 0),
      interface_edges_(interfaces.size()),
      outboxes_(interfaces.size()) {
    if (!interfaces.empty()) shared_.assign(stars.end_index().value(), 0);
    for (std::size_t i = 0; i < interfaces.size(); ++i) {
        for (const auto& [a, b] : interfaces[i].edges) {
            const EdgeIndex edge = stars.find(a, b);
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
        if ((missing >> e & 1U) != 0) select(stars_->edges_of(cell)[e]);
    }
}

// To know the cells at each edge takes as long as several sweeps. Most often they are enough, as
// every other one goes backwards; but a path may turn round as often as it likes.
void DenseClosure::drain() {
    constexpr int most_sweeps = 8;
    if (sweep_count_ == 0 && selected_count_ < selected_.size()) sweep();
    while (!queue_.empty() && sweep_count_ < most_sweeps) sweep();
    if (queue_.empty()) return;
    if (cells_begin_.empty()) index_cells_at_edges();
    while (!queue_.empty()) {
        const EdgeIndex edge = queue_.back();
        queue_.pop_back();
        for (auto k = cells_begin_[edge.value()]; k < cells_begin_[edge.value() + 1]; ++k) {
            close(cells_[k]);
        }
    }
}

/// Closes every cell; what is selected meanwhile may concern cells that were passed already.
void DenseClosure::sweep() {
    queue_.clear();
    const bool backwards = sweep_count_++ % 2 != 0;
    const std::size_t count = orders_->end_index().value();
    for (std::size_t i = 0; i < count; ++i) close(CellIndex{backwards ? count - 1 - i : i});
}

void DenseClosure::index_cells_at_edges() {
    cells_begin_.assign(std::size_t{stars_->end_index().value()} + 1, 0);
    for (CellIndex c{0}; c < orders_->end_index(); ++c) {
        for (const EdgeIndex e : stars_->edges_of(c)) ++cells_begin_[e.value()];
    }
    std::exclusive_scan(cells_begin_.begin(), cells_begin_.end(), cells_begin_.begin(), 0U);
    cells_.resize(cells_begin_.back());
    // Filling moves each beginning to its end, which is the next one's beginning ...
    for (CellIndex c{0}; c < orders_->end_index(); ++c) {
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
