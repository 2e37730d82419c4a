#include <octetra/distributed/refine.hpp>

#include <functional>
#include <utility>

#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/even_level.hpp"
#include "adapt/step_options.hpp"
#include "level/planned_level.hpp"
#include "level/tuning.hpp"

namespace octetra::distributed {
namespace {

/// Collective. Returns the number of cells of this process that were processed.
std::size_t bisect_and_commit(DistributedMesh& mesh, PlannedLevel& plan,
                              const RefineOptions& options, int level) {
    bisect_level(plan, mesh, options, level);
    const std::size_t touched = plan.tested + plan.level->cells_touched();
    plan.commit();
    return touched;
}

/// Collective. Migrates roots, and bisects the level. On failure, only the order and the roots of
/// the mesh may have changed.
std::size_t move_and_bisect(DistributedMesh& mesh, UnevenLevel uneven, const RefineOptions& options,
                            const Tuning& tuning, int level) {
    uneven.keep_mesh();
    std::optional<AdaptiveMesh::State> state = state_of(mesh);
    try {
        MovedLevel moved = moved_level(*state, uneven, options, tuning);
        const std::size_t touched =
            bisect_and_commit(moved.state->mesh, moved.plan, options, level);
        moved.plan = {};
        mesh = std::move(moved.state->mesh);
        return touched;
    } catch (...) {
        mesh = std::move(state->mesh);
        throw;
    }
}

}  // namespace

SynchronisationCounts refine(DistributedMesh& mesh, const Selection& selection,
                             const RefineOptions& options, const Tuning& tuning) {
    const StandardArithmetic standard;
    SynchronisationCounts total;
    if (options.balance) {
        const Phase phase(mesh.processes, "select");
        check_same(mesh.processes, *options.balance);
    }
    note_cells(mesh.processes, 0, mesh.cells.size(), 0);
    RefineOptions of_level = options;
    std::uint64_t accumulated_idle = 0;
    for (int level = 1; level <= options.levels; ++level) {
        const Phase phase(mesh.processes, "level", level);
        const auto mark = [&] { return mark_cells(mesh, selection, level > 1); };
        of_level.is_last = options.is_last && level == options.levels;
        PlannedLevel plan = close_level(mesh, std::ref(mark), of_level, tuning);
        if (!plan.changes_anything()) break;  // nor would any later level
        const SynchronisationCounts counts = plan.counts;
        std::optional<UnevenLevel> uneven;
        if (options.balance)
            uneven = uneven_level(mesh, plan, *options.balance, of_level, tuning, accumulated_idle);
        const std::size_t touched =
            uneven ? move_and_bisect(mesh, *std::move(uneven), of_level, tuning, level)
                   : bisect_and_commit(mesh, plan, of_level, level);
        total += counts;
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
