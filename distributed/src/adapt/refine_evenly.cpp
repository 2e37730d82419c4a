#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/even_level.hpp"
#include "adapt/mesh_state.hpp"
#include "adapt/numbered_level.hpp"
#include "adapt/step_options.hpp"

namespace octetra::distributed {

EvenStep refine_state_evenly(AdaptiveMesh::State& state, const std::function<MarkedCells()>& mark,
                             const BalanceOptions& balance, const StepOptions& options,
                             const Tuning& tuning) {
    const StandardArithmetic standard;
    if (options.closure == Closure::regular) {
        return refine_state_evenly_and_regularly(state, mark, balance, options, tuning);
    }
    const Communicator processes = state.mesh.processes;
    const int level = state.step_count + 1;
    const Phase phase(processes, "level", level);
    std::uint64_t accumulated_idle = state.accumulated_idle;
    std::optional<UnevenLevel> uneven;
    MovedState moved;
    std::optional<NumberedLevel> numbered;  // of the moved state, if there is one
    processes.transaction([&] {
        check_same(processes, options);
        check_closure(state, options);
        check_same(processes, balance);
        const RefineOptions level_of = level_options(options);
        state.note_cells_before_level();
        moved.migration = unmoved(state.mesh);
        PlannedLevel plan = close_level(state.mesh, mark, level_of, tuning);
        if (!plan.changes_anything()) return;
        uneven = uneven_level(state.mesh, plan, balance, level_of, tuning, accumulated_idle,
                              &state.numbers);
        if (uneven) {
            state.forgotten.reserve(state.forgotten.size() + 1);
            MovedLevel moved_plan = moved_level(state, *uneven, level_of, tuning);
            moved_plan.plan.counts = plan.counts;
            moved = std::move(moved_plan.to);
            plan = std::move(moved_plan.plan);
        }
        AdaptiveMesh::State& of_level = uneven ? *moved.state : state;
        bisect_level(plan, of_level.mesh, level_of, level);
        numbered.emplace(of_level, std::move(plan));
    });
    if (!numbered) return {std::move(moved.migration), unchanged(state.mesh)};
    EvenStep done{std::move(moved.migration), numbered->commit()};
    numbered.reset();
    state.accumulated_idle = accumulated_idle;
    state.mesh.closure = options.closure;
    if (!uneven) return done;
    std::unique_ptr<CellsAsRoots> roots = std::move(uneven->roots);
    uneven->keep_mesh();
    state.replace_by(std::move(*moved.state), std::move(roots));
    return done;
}

}  // namespace octetra::distributed
