#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <octetra/distributed/refine.hpp>
#include <octetra/distributed/succession.hpp>

#include "level/closure.hpp"
#include "level/rounding_failure.hpp"
#include "mark/marked_cells.hpp"
#include "pattern/patterns.hpp"

namespace octetra::distributed {

/// What becomes of a process's lists.
struct ListChanges {
    Succession cells;
    Succession facets;
    Succession edges;  ///< tagged ones
};

/// What one process does at one level, step by step; see refine_level(). There are two ways, and
/// each process takes the one that suits its own part: nothing of them shows outside. No step is
/// collective.
///
/// Until commit() the mesh is as it was, but for the midpoints behind its vertices. Whoever
/// destroys a level that was not committed has the mesh as it was before: a step may throw.
class Level {
public:
    Level() = default;
    virtual ~Level() = default;
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    Level(Level&&) = delete;
    Level& operator=(Level&&) = delete;

    /// The marked edges, of marked cells as yet, to be closed together with the other processes.
    [[nodiscard]] virtual Closure& closure() = 0;

    /// Of the closed level: the cells that it bisects, ascending, each with its marked edges.
    [[nodiscard]] virtual MarkedCells closed_marks() = 0;

    /// Appends midpoints to the mesh's vertices.
    virtual void bisect_edges() = 0;
    /// Of the closed level; may be asked for before anything is bisected.
    [[nodiscard]] virtual std::size_t cell_count_afterwards() = 0;
    /// Into so many. Where a failure is found, the level must not be committed.
    [[nodiscard]] virtual RoundingFailure bisect_cells(std::size_t cell_count) = 0;
    virtual void bisect_tagged() = 0;
    virtual void bisect_interfaces() = 0;

    /// Of the level that is ready to be committed: the midpoints of the shared edges that it
    /// bisects, by interface, in the order of the edges in its list, which both sides know.
    [[nodiscard]] virtual std::vector<std::vector<VertexIndex>> shared_midpoints() const = 0;
    /// And how the process's lists change.
    [[nodiscard]] virtual ListChanges changes() = 0;

    /// Once all steps are done: from now on the mesh is the level's result.
    virtual void commit() noexcept = 0;

    /// How many cells were looked at beyond judging them.
    [[nodiscard]] virtual std::size_t cells_touched() const = 0;
};

/// The edges that a marked cell marks.
[[nodiscard]] inline EdgeMask marks_of(Scheme scheme, LengthOrder order) {
    const PatternTable& table = PatternTable::get();
    switch (scheme) {
        case Scheme::eight: return all_edges;
        case Scheme::four: return table.face_longest_edges(order);
        case Scheme::two: return static_cast<EdgeMask>(1U << table.longest_edge(order));
    }
    return 0;
}

/// The child that a pattern describes, of a cell whose corners and midpoints are `vertices`, by
/// place.
[[nodiscard]] inline CellVertices child_of(const std::array<VertexIndex, 10>& vertices,
                                           const std::array<Place, 4>& places) {
    CellVertices child;
    for (std::size_t i = 0; i < 4; ++i) child[i] = vertices[places[i]];
    return child;
}

}  // namespace octetra::distributed
