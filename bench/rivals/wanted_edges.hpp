#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "rivals/border.hpp"
#include "rivals/cell_graph.hpp"

namespace octetra::rivals {

/// The edges on the propagation paths of the cells that are to be cut, followed as cells are cut,
/// and never searched for again. Every wanted edge counts the cells around it that have a longer
/// edge: those wait, in a list of the cell, for its being cut. Of a cell whose longest edge is
/// wanted the flag is set. What is wanted once is wanted until it is bisected.
///
/// An edge that ranks share is wanted by each of them by itself, and awaits the rank's own cells.
/// The others are told when it is first wanted, and when the rank has no cells in its way any more;
/// it is terminal when all have said so.
class WantedEdges {
public:
    struct Edge {
        EdgeVertices ends;          ///< the one with the lower number first
        CellIndex cell;             ///< one around it; whose longest it is, if it is terminal
        std::uint32_t awaited = 0;  ///< cells around it with a longer edge
        SharedEdgeIndex shared = not_shared;
    };

    /// `border` is null where there are no other ranks.
    WantedEdges(CellGraph& graph, Border* border) : graph_(&graph), border_(border) {}

    /// Wants the longest edge of a cell; follow_paths() what must be bisected before.
    void want(CellIndex c) { to_want_.push_back(c); }
    /// Tells those that wait for a cell that it was cut into these, of which the first has its
    /// number and its list. To be told of all cells of a star before paths are followed.
    void pass_on(CellIndex one, CellIndex other);
    void follow_paths();
    /// Another rank wants an edge that it shares with this one.
    void want_shared(SharedEdgeIndex e);

    /// Those that have become terminal since this was last asked.
    void take_terminal(std::vector<Edge>& edges) { take(terminal_, edges); }
    /// Shared edges that have no cell of this rank in their way any more.
    void take_ready(std::vector<Edge>& edges) { take(ready_, edges); }
    /// Shared edges that this rank has come to want without having been told.
    [[nodiscard]] std::vector<SharedEdgeIndex> take_asked() { return std::exchange(asked_, {}); }
    /// How many are wanted and have not been taken.
    [[nodiscard]] std::size_t count() const { return edges_.size() - free_edges_.size(); }

private:
    struct Waiter {
        std::uint32_t edge = 0;
        std::uint32_t next = no_waiter;
    };

    void want_now(CellIndex c);
    void add(const EdgeVertices& ends, CellIndex c, SharedEdgeIndex shared);
    void meet(std::uint32_t edge, CellIndex c);
    void wait_for(CellIndex c, std::uint32_t edge);
    void check(std::uint32_t edge);
    std::uint32_t put(const Edge& edge);
    void take(std::vector<std::uint32_t>& list, std::vector<Edge>& edges);

    CellGraph* graph_;
    Border* border_;
    std::vector<Edge> edges_;
    std::vector<std::uint32_t> free_edges_;
    std::vector<std::uint32_t> terminal_;
    std::vector<std::uint32_t> ready_;
    std::vector<SharedEdgeIndex> asked_;
    std::vector<Waiter> waiters_;
    std::uint32_t free_waiter_ = no_waiter;
    std::vector<CellIndex> to_want_;
    Star star_;
};

}  // namespace octetra::rivals
