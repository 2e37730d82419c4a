#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "rivals/cell_graph.hpp"

namespace octetra::rivals {

/// The edges on the propagation paths of the cells that are to be cut, followed as cells are cut,
/// and never searched for again. Every wanted edge counts the cells around it that have a longer
/// edge: those wait, in a list of the cell, for its being cut. Of a cell whose longest edge is
/// wanted the flag is set. What is wanted once is wanted until it is bisected.
///
/// If cells have parts, an edge is wanted by each part by itself, awaits the part's own cells, and
/// is terminal if it has cells of this part alone. One that has others, too, is told of when it is
/// first wanted, and when the part has no cells in its way any more.
class WantedEdges {
public:
    struct Edge {
        EdgeVertices ends;          ///< the one with the lower number first
        CellIndex cell;             ///< one around it; whose longest it is, if it is terminal
        std::uint32_t awaited = 0;  ///< cells around it with a longer edge
        int part = 0;
        bool is_shared = false;  ///< with another part
    };

    /// `part_of_root` has a part for each cell of the input, or is empty.
    WantedEdges(CellGraph& graph, std::vector<int> part_of_root)
        : graph_(&graph), part_of_root_(std::move(part_of_root)) {}

    /// Wants the longest edge of a cell; follow_paths() what must be bisected before.
    void want(CellIndex c) { to_want_.push_back(c); }
    /// Tells those that wait for a cell that it was cut into these, of which the first has its
    /// number and its list. To be told of all cells of a star before paths are followed.
    void pass_on(CellIndex one, CellIndex other);
    void follow_paths();
    /// A part learns that another one wants the longest edge of this cell, which it shares.
    void want_in(int part, CellIndex c);

    /// Those that have become terminal since this was last asked.
    void take_terminal(std::vector<Edge>& edges) { take(terminal_, edges); }
    /// Shared edges that a part has no more to do for.
    void take_ready(std::vector<Edge>& edges) { take(ready_, edges); }
    /// Shared edges that a part has come to want without having been told.
    void take_asked(std::vector<Edge>& edges) { edges = std::exchange(asked_, {}); }
    /// How many are wanted and have not been taken.
    [[nodiscard]] std::size_t count() const { return edges_.size() - free_edges_.size(); }

    [[nodiscard]] int part(CellIndex c) const {
        return part_of_root_.empty() ? 0 : part_of_root_[graph_->cells[c].root.value()];
    }

private:
    struct Waiter {
        std::uint32_t edge = 0;
        std::uint32_t next = no_waiter;
    };

    void want_now(CellIndex c);
    std::uint32_t add(CellIndex c, int part);
    void meet(std::uint32_t edge, CellIndex c);
    void wait_for(CellIndex c, std::uint32_t edge);
    void check(std::uint32_t edge);
    [[nodiscard]] bool waits_for(CellIndex c, const EdgeVertices& ends) const;
    std::uint32_t put(const Edge& edge);
    void take(std::vector<std::uint32_t>& list, std::vector<Edge>& edges);

    CellGraph* graph_;
    std::vector<int> part_of_root_;
    std::vector<Edge> edges_;
    std::vector<std::uint32_t> free_edges_;
    std::vector<std::uint32_t> terminal_;
    std::vector<std::uint32_t> ready_;
    std::vector<Edge> asked_;
    std::vector<Waiter> waiters_;
    std::uint32_t free_waiter_ = no_waiter;
    std::vector<CellIndex> to_want_;
    Star star_;
};

}  // namespace octetra::rivals
