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

/// A mesh on its way to a goal: cells, and the edges that are wanted. Whoever has it decides when
/// an edge that is terminal is bisected.
class Cutting {
public:
    /// `border` is that of the graph, or null where there are no other ranks.
    explicit Cutting(CellGraph graph, Border* border = nullptr)
        : graph_(std::move(graph)),
          border_(border),
          wanted_(graph_, border),
          input_points_(graph_.points.size()),
          is_cut_(graph_.cells.size(), 0) {}
    Cutting(const Cutting&) = delete;
    Cutting& operator=(const Cutting&) = delete;
    ~Cutting() = default;

    /// Wants what is to be cut. Throws InputError for a goal that makes no sense.
    void begin(const Goal& goal, std::size_t max_cells);
    /// Bisects the star of a terminal edge that was wanted, and wants what is to be cut of it.
    /// Throws InputError where a child is not positively oriented, or for too many cells.
    void bisect(const WantedEdges::Edge& edge);

    [[nodiscard]] const CellGraph& graph() const { return graph_; }
    [[nodiscard]] WantedEdges& wanted() { return wanted_; }
    /// What the midpoints are midpoints of. The input's points come before them.
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
    IndexVector<CellIndex, std::uint8_t> is_cut_;  // of the input's cells
    std::vector<EdgeVertices> midpoint_to_edge_;
    Star star_;
};

}  // namespace octetra::rivals
