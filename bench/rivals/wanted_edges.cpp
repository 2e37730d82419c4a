#include "rivals/wanted_edges.hpp"

#include <algorithm>

namespace octetra::rivals {
namespace {

bool has(const CellVertices& cell, VertexIndex v) {
    return cell[0] == v || cell[1] == v || cell[2] == v || cell[3] == v;
}

}  // namespace

void WantedEdges::follow_paths() {
    while (!to_want_.empty()) {
        const CellIndex next = to_want_.back();
        to_want_.pop_back();
        want_now(next);
    }
}

void WantedEdges::want_now(CellIndex c) {
    if (graph_->cells[c].longest_is_wanted) return;
    const EdgeVertices ends = ascending(graph_->longest_edge_of(c));
    const SharedEdgeIndex shared = border_ == nullptr ? not_shared : border_->find(ends);
    if (shared != not_shared) asked_.push_back(shared);
    graph_->find_star(c, star_);
    add(ends, c, shared);
}

void WantedEdges::want_shared(SharedEdgeIndex e) {
    if (border_->edge(e).is_wanted) return;
    const EdgeVertices ends = ascending(border_->edge(e).ends);
    graph_->find_star(ends, star_);
    add(ends, star_.cells.front().cell, e);
    follow_paths();
}

/// Adds a wanted edge, whose star is in `star_`.
void WantedEdges::add(const EdgeVertices& ends, CellIndex c, SharedEdgeIndex shared) {
    if (shared != not_shared) border_->edge(shared).is_wanted = true;
    const std::uint32_t edge = put({.ends = ends, .cell = c, .shared = shared});
    for (const StarCell& at : star_.cells) relate(edge, at.cell);
    check(edge);
}

/// Relates a wanted edge to a cell around it: it is the cell's longest edge, or the cell is in its
/// way.
void WantedEdges::relate(std::uint32_t edge, CellIndex c) {
    if (ascending(graph_->longest_edge_of(c)) == edges_[edge].ends) {
        graph_->cells[c].longest_is_wanted = true;
        return;
    }
    wait_for(c, edge);
    to_want_.push_back(c);
}

void WantedEdges::check(std::uint32_t edge) {
    if (edges_[edge].awaited > 0) return;
    (edges_[edge].shared == not_shared ? terminal_ : ready_).push_back(edge);
}

void WantedEdges::update_waiters(CellIndex one, CellIndex other) {
    std::uint32_t w = std::exchange(graph_->cells[one].first_waiter, no_waiter);
    while (w != no_waiter) {
        const Waiter waiter = waiters_[w];
        waiters_[w].next = std::exchange(free_waiter_, w);
        w = waiter.next;

        --edges_[waiter.edge].awaited;
        const auto [a, b] = edges_[waiter.edge].ends;
        for (const CellIndex child : {one, other}) {
            const CellVertices& vertices = graph_->cells[child].vertices;
            if (has(vertices, a) && has(vertices, b)) relate(waiter.edge, child);
        }
        check(waiter.edge);
    }
}

void WantedEdges::wait_for(CellIndex c, std::uint32_t edge) {
    ++edges_[edge].awaited;
    std::uint32_t w = free_waiter_;
    if (w == no_waiter) {
        w = static_cast<std::uint32_t>(waiters_.size());
        waiters_.emplace_back();
    } else {
        free_waiter_ = waiters_[w].next;
    }
    waiters_[w] = {edge, std::exchange(graph_->cells[c].first_waiter, w)};
}

std::uint32_t WantedEdges::put(const Edge& edge) {
    if (free_edges_.empty()) {
        edges_.push_back(edge);
        return static_cast<std::uint32_t>(edges_.size() - 1);
    }
    const std::uint32_t place = free_edges_.back();
    free_edges_.pop_back();
    edges_[place] = edge;
    return place;
}

void WantedEdges::take(std::vector<std::uint32_t>& list, std::vector<Edge>& edges) {
    edges.clear();
    for (const std::uint32_t edge : list) {
        edges.push_back(edges_[edge]);
        free_edges_.push_back(edge);
    }
    list.clear();
}

}  // namespace octetra::rivals
