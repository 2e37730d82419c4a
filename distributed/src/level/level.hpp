#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include <octetra/distributed/entity_transfer.hpp>
#include <octetra/distributed/refine.hpp>

#include "level/made_change.hpp"
#include "level/marked_cells.hpp"
#include "level/marked_edges.hpp"
#include "level/rounding_failure.hpp"
#include "pattern/patterns.hpp"

namespace octetra::distributed {

/// The changes of a process's lists by a level.
struct ListChanges {
    EntityTransfer cells;
    EntityTransfer facets;
    EntityTransfer edges;  ///< tagged ones
};

/// One level on one process, step by step; see PlannedLevel. There are two implementations, and
/// each process uses the one that suits its own part; the results are the same. No step is
/// collective.
///
/// Until commit() the mesh is unchanged except for the midpoints appended to its vertices. A level
/// that is destroyed without commit() restores the mesh: each step may throw.
class Level {
public:
    Level() = default;
    virtual ~Level() = default;
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    Level(Level&&) = delete;
    Level& operator=(Level&&) = delete;

    /// The marked edges, at first those of the marked cells; to be closed together with the other
    /// processes.
    [[nodiscard]] virtual MarkedEdges& closure() = 0;

    /// Returns the cells that the closed level bisects, ascending, each with its marked edges.
    [[nodiscard]] virtual MarkedCells closed_marks() = 0;

    /// Appends midpoints to the mesh's vertices.
    virtual void bisect_edges() = 0;
    /// Returns the number of cells after the closed level; may be called before anything is
    /// bisected.
    [[nodiscard]] virtual std::size_t cell_count_afterwards() = 0;
    /// Bisects the cells into `cell_count` ones. If a failure is found, the level must not be
    /// committed.
    [[nodiscard]] virtual RoundingFailure bisect_cells(std::size_t cell_count) = 0;
    virtual void bisect_tagged() = 0;
    virtual void bisect_interfaces() = 0;

    /// Returns the midpoints of the shared edges that the level bisects, by interface, in the order
    /// of the edges in its list, which both ranks have in common. To be called when the level is
    /// ready to be committed.
    [[nodiscard]] virtual std::vector<std::vector<VertexIndex>> shared_midpoints() const = 0;
    /// Returns the changes of the process's lists; called at the same time.
    [[nodiscard]] virtual ListChanges changes() = 0;

    /// Replaces the mesh by the result of the level, once all steps are done.
    virtual void commit() noexcept = 0;
    /// The same, so that it can be reverted as long as no later change remains. Throws before
    /// anything changes.
    [[nodiscard]] virtual std::unique_ptr<MadeChange> commit_reversibly() = 0;

    /// Returns the number of cells that were processed, not counting tests by the selection.
    [[nodiscard]] virtual std::size_t cells_touched() const = 0;
};

/// Returns the edges that a marked cell marks.
[[nodiscard]] inline EdgeMask marks_of(Scheme scheme, LengthOrder order) {
    const PatternTable& table = PatternTable::get();
    switch (scheme) {
        case Scheme::eight: return all_edges;
        case Scheme::four: return table.face_longest_edges(order);
        case Scheme::two: return static_cast<EdgeMask>(1U << table.longest_edge(order));
    }
    return 0;
}

/// Returns the child of a cell with corners at the positions `places` of a pattern; `vertices` has
/// the vertices of the cell at all positions: its corners, then the midpoints of its edges.
[[nodiscard]] inline CellVertices child_of(const std::array<VertexIndex, 10>& vertices,
                                           const std::array<PatternVertex, 4>& places) {
    CellVertices child;
    for (std::size_t i = 0; i < 4; ++i) child[i] = vertices[places[i]];
    return child;
}

}  // namespace octetra::distributed
