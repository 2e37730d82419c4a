#include <memory>
#include <utility>

#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/even_level.hpp"
#include "adapt/mesh_state.hpp"
#include "adapt/step_options.hpp"

namespace octetra::distributed {

EvenStep refine_state_evenly(AdaptiveMesh::State& state, const std::function<MarkedCells()>& mark,
                             const BalanceOptions& balance, const StepOptions& options,
                             const Tuning& tuning) {
    const StandardArithmetic standard;
    check_same(state.mesh.processes, options);
    check_same(state.mesh.processes, balance);
    const RefineOptions level_of = level_options(options);
    const int level = state.step_count + 1;
    const Phase phase(state.mesh.processes, "level", level);
    state.note_cells_before_level();
    PlannedLevel plan = close_level(state.mesh, mark, level_of, tuning);
    if (!plan.changes_anything()) return {unmoved(state.mesh), unchanged(state.mesh)};
    const SynchronisationCounts counts = plan.counts;
    std::optional<UnevenLevel> uneven = uneven_level(state.mesh, plan, balance, level_of, tuning,
                                                     state.accumulated_idle, &state.numbers);
    if (!uneven) {
        Migration nothing = unmoved(state.mesh);  // of the mesh before the level
        bisect_level(plan, state.mesh, level_of, level);
        return {std::move(nothing), state.take(plan)};
    }
    if (uneven->roots != nullptr) state.reserve_history();
    MovedLevel moved = moved_level(state, *uneven, level_of, tuning);
    bisect_level(moved.plan, moved.state->mesh, level_of, level);
    EvenStep done{std::move(moved.migration), moved.state->take(moved.plan)};
    done.step.synchronisation = counts;
    moved.plan = {};
    std::unique_ptr<CellsAsRoots> roots = std::move(uneven->roots);
    if (uneven->order != nullptr) uneven->order->keep();
    uneven.reset();
    state.replace_by(std::move(*moved.state), std::move(roots));
    return done;
}

}  // namespace octetra::distributed
