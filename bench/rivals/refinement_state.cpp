#include "rivals/refinement_state.hpp"

#include <algorithm>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/orientation.hpp>

#include "rivals/longest_edge.hpp"
#include "rivals/sizes.hpp"

namespace octetra::rivals {
namespace {

void check(const Goal& goal, std::size_t cells) {
    if (!goal.targets.empty() && goal.targets.size() != cells) {
        throw InputError("a goal has targets for another number of cells");
    }
    if (goal.longest_edge && !is_sure_square(*goal.longest_edge * *goal.longest_edge)) {
        throw InputError("a goal has a length that has no square");
    }
    if (goal.volume && !(*goal.volume > 0)) throw InputError("a goal has no volume");
}

}  // namespace

void RefinementState::begin(const Goal& goal, std::size_t max_cells) {
    check(goal, is_cut_.size());
    goal_ = goal;
    max_cells_ = std::min<std::size_t>(max_cells, CellIndex::limit);
    for (CellIndex c{0}; c < graph_.cells.end_index(); ++c) {
        if (is_to_be_cut(c)) wanted_.want(c);
    }
    wanted_.follow_paths();
}

bool RefinementState::is_to_be_cut(CellIndex c) const {
    const CellIndex root = graph_.cells[c].root;
    if (!goal_.targets.empty() && goal_.targets[root.value()] == 0) return false;
    if (goal_.longest_edge) {
        const auto& [a, b] = graph_.longest_edge_of(c);
        const double h = *goal_.longest_edge;
        if (squared_length({graph_.points[a], graph_.points[b]}) > h * h) return true;
    }
    if (goal_.volume) return is_larger(graph_.corners(c), *goal_.volume);
    return !goal_.longest_edge && is_cut_[root] == 0;
}

void RefinementState::set_longest(CellIndex child) {
    const Corners corners = graph_.corners(child);
    const auto& [a, b, c, d] = corners;
    if (orientation(a, b, c, d) <= 0) {
        throw InputError("a midpoint, rounded, would flatten or invert a cell");
    }
    graph_.cells[child].longest = longest_edge(corners);
    graph_.cells[child].longest_is_wanted = false;
}

void RefinementState::bisect(const WantedEdges::Edge& edge) {
    const auto& [a, b] = edge.ends;
    const bool is_shared = edge.shared != not_shared;
    is_shared ? graph_.find_star(edge.ends, star_) : graph_.find_star(edge.cell, star_);
    const Point middle = midpoint(graph_.points[a], graph_.points[b]);
    const std::size_t first_new = graph_.cells.size();
    if (first_new + star_.cells.size() > max_cells_) {
        throw InputError("there would be too many cells");
    }
    const VertexIndex at_middle = graph_.points.append(middle);
    graph_.bisect(star_, at_middle);
    if (is_shared) border_->bisect(edge.shared, at_middle, graph_, star_);
    midpoint_to_edge_.push_back(edge.ends);
    for (std::size_t i = 0; i < star_.cells.size(); ++i) {
        is_cut_[graph_.cells[star_.cells[i].cell].root] = 1;
        set_longest(star_.cells[i].cell);
        set_longest(CellIndex{first_new + i});
    }
    for (std::size_t i = 0; i < star_.cells.size(); ++i) {
        const CellIndex one = star_.cells[i].cell;
        const CellIndex other{first_new + i};
        wanted_.update_waiters(one, other);
        for (const CellIndex child : {one, other}) {
            if (is_to_be_cut(child)) wanted_.want(child);
        }
    }
    wanted_.follow_paths();
}

}  // namespace octetra::rivals
