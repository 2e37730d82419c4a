#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include <octetra/distributed/communicator.hpp>

#include "level/marked_cells.hpp"
#include "level/transition_cells.hpp"
#include "pattern/patterns.hpp"

namespace octetra::distributed {

/// The marked edges that are not bisected yet: for each cell, those that the cell marks. Other
/// cells with the edges need not have them.
class PendingEdges {
public:
    PendingEdges(const Communicator& processes, std::size_t cell_count)
        : processes_(processes), of_cell_(cell_count, 0), open_(cell_count, 0) {}

    /// Adds edges that are closed.
    void add(CellIndex cell, unsigned edges) {
        of_cell_[cell] = static_cast<EdgeMask>(of_cell_[cell] | edges);
    }
    /// Adds edges; those that are new are not closed.
    void add_open(CellIndex cell, unsigned edges) {
        open_[cell] = static_cast<EdgeMask>(open_[cell] | (edges & ~unsigned{of_cell_[cell]}));
        add(cell, edges);
    }
    [[nodiscard]] EdgeMask of(CellIndex cell) const { return of_cell_[cell]; }
    [[nodiscard]] EdgeMask open_of(CellIndex cell) const { return open_[cell]; }

    /// Returns the cells that mark edges of a generation, each with these edges.
    [[nodiscard]] MarkedCells of_generation(std::uint32_t generation,
                                            const TransitionCells& cells) const {
        return selected(of_cell_, generation, cells);
    }
    /// The same for edges that are not closed, which are closed then.
    [[nodiscard]] MarkedCells take_open(std::uint32_t generation, const TransitionCells& cells) {
        MarkedCells marked = selected(open_, generation, cells);
        for (std::size_t k = 0; k < marked.cells.size(); ++k) {
            EdgeMask& open = open_[marked.cells[k]];
            open = static_cast<EdgeMask>(open & ~unsigned{marked.edges[k]});
        }
        return marked;
    }

    /// Collective. Returns the greatest generation below `limit` of which any process has edges.
    [[nodiscard]] std::optional<std::uint32_t> greatest_below(std::uint64_t limit,
                                                              const TransitionCells& cells) const {
        std::uint64_t end = 0;  // one more than the greatest generation
        for_each_generation(cells, [&](std::uint64_t generation) {
            if (generation < limit) end = std::max(end, generation + 1);
        });
        const std::uint64_t greatest = processes_.max(end);
        if (greatest == 0) return std::nullopt;
        return static_cast<std::uint32_t>(greatest - 1);
    }
    /// Collective. Returns the least generation of which any process has edges.
    [[nodiscard]] std::optional<std::uint32_t> least(const TransitionCells& cells) const {
        constexpr std::uint64_t complement = std::numeric_limits<std::uint32_t>::max();
        std::uint64_t least = complement;
        for_each_generation(cells,
                            [&](std::uint64_t generation) { least = std::min(least, generation); });
        const std::uint64_t greatest = processes_.max(complement - least);
        if (greatest == 0) return std::nullopt;
        return static_cast<std::uint32_t>(complement - greatest);
    }

private:
    using Masks = IndexVector<CellIndex, EdgeMask>;

    static MarkedCells selected(const Masks& masks, std::uint32_t generation,
                                const TransitionCells& cells) {
        MarkedCells marked;
        for (CellIndex c{0}; c < masks.end_index(); ++c) {
            if (masks[c] == 0) continue;
            const EdgeMask edges = cells.edges_of_generation(c, generation) & masks[c];
            if (edges == 0) continue;
            marked.cells.push_back(c);
            marked.edges.push_back(edges);
        }
        marked.count = marked.cells.size();
        return marked;
    }

    /// Calls f with the generation of the edges of each cell that has any; twice if a cell has
    /// edges of two generations.
    void for_each_generation(const TransitionCells& cells, auto&& f) const {
        for (CellIndex c{0}; c < of_cell_.end_index(); ++c) {
            if (of_cell_[c] == 0) continue;
            const std::uint32_t newest = cells.generation_of(c);
            const EdgeMask of_parent = cells.contains(c) ? cells.edges_of_parent(c) : EdgeMask{0};
            if ((of_cell_[c] & of_parent) != 0) f(newest - 1);
            if ((of_cell_[c] & ~unsigned{of_parent}) != 0) f(newest);
        }
    }

    Communicator processes_;
    Masks of_cell_;
    Masks open_;  ///< those whose closure may not be marked yet
};

}  // namespace octetra::distributed
