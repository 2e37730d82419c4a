#pragma once

#include <functional>
#include <memory>

#include "level/incremental/adjacency.hpp"
#include "level/level.hpp"
#include "level/tuning.hpp"
#include "mark/marked_cells.hpp"

namespace octetra::distributed {

/// A level that all processes can commit. Until it is committed the mesh is as it was, but for the
/// order that it may be in and the midpoints behind its vertices; destroyed before, it leaves the
/// mesh as it was in these, too.
struct PlannedLevel {
    std::unique_ptr<CanonicalOrder> order;  ///< that the level needed, or null
    std::unique_ptr<Level> level;           ///< null: nothing is marked on any process
    SynchronisationCounts counts;
    std::size_t judged = 0;  ///< cells of this process that the selection looked at

    [[nodiscard]] bool changes_anything() const { return level != nullptr; }
    /// What becomes of this process's lists, by the numbers that they have now.
    [[nodiscard]] ListChanges changes();
    void commit() noexcept {
        level->commit();
        if (order != nullptr) order->keep();
    }
};

/// Collective. Marks and closes; nothing is bisected yet. Throws as plan_level() does.
[[nodiscard]] PlannedLevel close_level(DistributedMesh& mesh,
                                       const std::function<MarkedCells()>& mark_cells,
                                       const RefineOptions& options, const Tuning& tuning);

/// The level with edges of the marked cells marked, into `plan`. Where all know them to be closed,
/// that is a closed level. Not collective.
void begin_level(DistributedMesh& mesh, const RefineOptions& options, const Tuning& tuning,
                 MarkedCells marked, PlannedLevel& plan);

/// Collective. Bisects what is closed: then all processes can commit it. Throws as plan_level()
/// does.
void bisect_level(PlannedLevel& plan, const DistributedMesh& mesh, const RefineOptions& options,
                  int level);

/// The marked cells by the numbers that they have in another order, where `before` are those that
/// they had, or nothing where these are the same. Ascending.
[[nodiscard]] MarkedCells renumbered(MarkedCells marked, const std::vector<CellIndex>& before);

/// Collective. Plans level number `level`, counted from 1, for messages, of the cells that
/// `mark_cells` marks on this process. Throws as refine() does; a failure of one process, that of
/// an allocation among them, is thrown on all, and leaves the mesh as it was.
[[nodiscard]] PlannedLevel plan_level(DistributedMesh& mesh,
                                      const std::function<MarkedCells()>& mark_cells,
                                      const RefineOptions& options, const Tuning& tuning,
                                      int level);

/// Collective. The same, where the edges of the marked cells are known to be closed on all
/// processes together.
[[nodiscard]] PlannedLevel plan_closed_level(DistributedMesh& mesh,
                                             const std::function<MarkedCells()>& mark_cells,
                                             const Tuning& tuning, int level,
                                             const RefineOptions& options = {});

}  // namespace octetra::distributed
