#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "rivals/border.hpp"
#include "rivals/cell_graph.hpp"
#include "rivals/terminal_edges.hpp"
#include "rivals/wanted_edges.hpp"

namespace octetra::rivals {

/// The state of refinement towards a goal: cells, and the edges that are wanted. The caller decides
/// when a terminal edge is bisected.
class RefinementState {
public:
    /// `border` is that of the graph, or null without other ranks.
    explicit RefinementState(CellGraph graph, Border* border = nullptr)
        : graph_(std::move(graph)),
          border_(border),
          wanted_(graph_, border),
          input_points_(graph_.points.size()),
          is_cut_(graph_.cells.size(), 0) {}
    RefinementState(const RefinementState&) = delete;
    RefinementState& operator=(const RefinementState&) = delete;
    ~RefinementState() = default;

    /// Marks the longest edges of the cells to be cut as wanted. Throws InputError for an invalid
    /// goal.
    void begin(const Goal& goal, std::size_t max_cells);
    /// Bisects the star of a wanted terminal edge, and marks further edges of its cells as wanted.
    /// Throws InputError if a child is not positively oriented, or for too many cells.
    void bisect(const WantedEdges::Edge& edge);

    [[nodiscard]] const CellGraph& graph() const { return graph_; }
    [[nodiscard]] WantedEdges& wanted() { return wanted_; }
    /// The ends of the edge of each midpoint. Midpoints follow the points of the input.
    [[nodiscard]] const std::vector<EdgeVertices>& midpoint_to_edge() const {
        return midpoint_to_edge_;
    }
    [[nodiscard]] std::size_t input_points() const { return input_points_; }

private:
    void set_longest(CellIndex child);
    [[nodiscard]] bool is_to_be_cut(CellIndex c) const;

    CellGraph graph_;
    Border* border_;
    WantedEdges wanted_;
    Goal goal_;
    std::size_t max_cells_ = 0;
    std::size_t input_points_;
    IndexVector<CellIndex, std::uint8_t> is_cut_;  // for each cell of the input
    std::vector<EdgeVertices> midpoint_to_edge_;
    Star star_;
};

}  // namespace octetra::rivals
