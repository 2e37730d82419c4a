#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "rivals/border.hpp"
#include "rivals/cell_graph.hpp"

namespace octetra::rivals {

/// The edges on the propagation paths of the cells to be cut, updated as cells are cut instead of
/// being searched again. Every wanted edge counts the cells around it with a longer edge, in whose
/// waiter lists it is entered until they are cut. A flag is set for cells whose longest edge is
/// wanted. An edge stays wanted until it is bisected.
///
/// Each sharer of a shared edge wants it separately and awaits its own cells. It notifies the other
/// sharers when it first wants the edge, and when no cell of its own is in the way any longer; the
/// edge is terminal when all have done so.
class WantedEdges {
public:
    struct Edge {
        EdgeVertices ends;          ///< lower number first
        CellIndex cell;             ///< a cell around it; its longest edge, if terminal
        std::uint32_t awaited = 0;  ///< cells around it with a longer edge
        SharedEdgeIndex shared = not_shared;
    };

    /// `border` is null without other ranks.
    WantedEdges(CellGraph& graph, Border* border) : graph_(&graph), border_(border) {}

    /// Wants the longest edge of a cell; follow_paths() adds the edges to be bisected before.
    void want(CellIndex c) { to_want_.push_back(c); }
    /// Updates the edges that wait for a cell after it was cut into these two, the first of which
    /// keeps its index and list. To be called for all cells of a star before follow_paths().
    void update_waiters(CellIndex one, CellIndex other);
    void follow_paths();
    /// Notes that another rank wants an edge shared with this one.
    void want_shared(SharedEdgeIndex e);

    /// Returns the edges that have become terminal since the last call.
    void take_terminal(std::vector<Edge>& edges) { take(terminal_, edges); }
    /// Returns the shared edges that no cell of this rank blocks any longer.
    void take_ready(std::vector<Edge>& edges) { take(ready_, edges); }
    /// Returns the shared edges that this rank wants without notification by another one.
    [[nodiscard]] std::vector<SharedEdgeIndex> take_asked() { return std::exchange(asked_, {}); }
    /// The number of wanted edges that have not been taken.
    [[nodiscard]] std::size_t count() const { return edges_.size() - free_edges_.size(); }

private:
    struct Waiter {
        std::uint32_t edge = 0;
        std::uint32_t next = no_waiter;
    };

    void want_now(CellIndex c);
    void add(const EdgeVertices& ends, CellIndex c, SharedEdgeIndex shared);
    void relate(std::uint32_t edge, CellIndex c);
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
