#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <octetra/distributed/communicator.hpp>

#include "level/marked_cells.hpp"
#include "level/transition_cells.hpp"
#include "pattern/patterns.hpp"

namespace octetra::distributed {

/// The marked edges of a process that are not bisected yet. Those that are closed are listed for
/// each cell that has them; of the others, which are open, each is listed for any cell.
class PendingEdges {
public:
    void add_open(CellIndex cell, unsigned edges);
    /// Returns the open edges, which are not pending any more.
    [[nodiscard]] MarkedCells take_open();

    /// Adds closed edges, of any generation; the cells ascend.
    void add(const MarkedCells& closed, const TransitionCells& cells);

    /// The least and the greatest generation of closed edges on all processes; least > greatest if
    /// there are none.
    struct Generations {
        std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
        std::uint32_t greatest = 0;
    };
    /// Collective.
    [[nodiscard]] Generations generations(const Communicator& processes) const;

    /// Returns the closed edges of a generation, which are not pending any more.
    [[nodiscard]] MarkedCells take(std::uint32_t generation);
    /// Returns the closed edges of a cell, which are not pending any more.
    [[nodiscard]] unsigned take_of(CellIndex cell);

    /// Cells get new numbers, in the same order: `after(c)` is that of cell c. There must be no
    /// open edges.
    void renumber(auto&& after) {
        for (MarkedCells& closed : closed_) {
            for (CellIndex& c : closed.cells) c = after(c);
        }
    }
    /// Cells get new numbers: `before` has the present number of each. There must be no open edges.
    void reorder(const std::vector<CellIndex>& before);

private:
    MarkedCells open_;                 // in any order
    std::vector<MarkedCells> closed_;  // by generation; ascending
};

}  // namespace octetra::distributed
