#include <octetra/distributed/profile.hpp>
#include <octetra/distributed/refine.hpp>

#include "level/planned_level.hpp"
#include "level/tuning.hpp"

namespace octetra::distributed {

SynchronisationCounts refine(DistributedMesh& mesh, const Selection& selection,
                             const RefineOptions& options, const Tuning& tuning) {
    SynchronisationCounts total;
    note_cells(mesh.processes, 0, mesh.cells.size(), 0);
    for (int level = 1; level <= options.levels; ++level) {
        const Phase phase(mesh.processes, "level", level);
        const auto mark = [&] { return mark_cells(mesh, selection, level > 1); };
        PlannedLevel plan = plan_level(mesh, mark, options, tuning, level);
        if (!plan.changes_anything()) break;  // and so it would be at all further levels
        total += plan.counts;
        const std::size_t touched = plan.judged + plan.level->cells_touched();
        plan.commit();
        note_cells(mesh.processes, level, mesh.cells.size(), touched);
        const std::uint64_t cells = mesh.processes.sum(mesh.cells.size());
        if (options.on_level && mesh.processes.is_first()) options.on_level(level, cells);
    }
    return total;
}

SynchronisationCounts refine(DistributedMesh& mesh, const Selection& selection,
                             const RefineOptions& options) {
    return refine(mesh, selection, options, Tuning{});
}

}  // namespace octetra::distributed
