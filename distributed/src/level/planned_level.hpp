#pragma once

#include <functional>
#include <memory>

#include "level/incremental/adjacency.hpp"
#include "level/level.hpp"
#include "level/marked_cells.hpp"
#include "level/transition_cells.hpp"
#include "level/tuning.hpp"

namespace octetra::distributed {

/// A level that is ready to be committed on all processes. Until then the mesh is unchanged except
/// for its order and the midpoints appended to its vertices; destroying the object without commit()
/// restores these too.
struct PlannedLevel {
    std::unique_ptr<CanonicalOrder> order;  ///< the order that the level requires, or null
    std::unique_ptr<Level> level;           ///< null: nothing is marked on any process
    SynchronisationCounts counts;
    std::size_t tested = 0;  ///< cells of this process that the selection tested

    [[nodiscard]] bool changes_anything() const { return level != nullptr; }
    /// Returns the changes of this process's lists, by the local numbers before the level.
    [[nodiscard]] ListChanges changes();
    void commit() noexcept {
        level->commit();
        if (order != nullptr) order->keep();
    }
};

/// Collective. Marks and closes a level; nothing is bisected yet. Throws as plan_level() does. With
/// `transition`, marks complete families; see TransitionCells::close().
[[nodiscard]] PlannedLevel close_level(DistributedMesh& mesh,
                                       const std::function<MarkedCells()>& mark_cells,
                                       const RefineOptions& options, const Tuning& tuning,
                                       const TransitionCells* transition = nullptr);

/// Begins a level by marking edges of the marked cells, and stores it in `plan`. If the marks are
/// known to be closed on all processes, the result is a closed level. Not collective.
void begin_level(DistributedMesh& mesh, const RefineOptions& options, const Tuning& tuning,
                 MarkedCells marked, PlannedLevel& plan,
                 const TransitionCells* transition = nullptr);

/// Collective. Bisects a closed level, which all processes can then commit. Throws as plan_level()
/// does.
void bisect_level(PlannedLevel& plan, const DistributedMesh& mesh, const RefineOptions& options,
                  int level);

/// Returns the marked cells by their numbers in another order, ascending. `before` has the previous
/// number of each cell, or is empty if the order is the same.
[[nodiscard]] MarkedCells renumbered(MarkedCells marked, const std::vector<CellIndex>& before);

/// Collective. Plans a level for the cells that `mark_cells` marks on this process. `level`,
/// counted from 1, is for messages. Throws as refine() does, and leaves the mesh unchanged then.
[[nodiscard]] PlannedLevel plan_level(DistributedMesh& mesh,
                                      const std::function<MarkedCells()>& mark_cells,
                                      const RefineOptions& options, const Tuning& tuning,
                                      int level);

/// Collective. The same for marked cells whose edges are known to be closed over all processes.
[[nodiscard]] PlannedLevel plan_closed_level(DistributedMesh& mesh,
                                             const std::function<MarkedCells()>& mark_cells,
                                             const Tuning& tuning, int level,
                                             const RefineOptions& options = {});

}  // namespace octetra::distributed
