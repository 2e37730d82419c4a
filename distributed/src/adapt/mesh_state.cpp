#include "adapt/mesh_state.hpp"

#include <memory>
#include <optional>
#include <utility>

#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/numbered_level.hpp"
#include "adapt/step_options.hpp"
#include "profile/recorder.hpp"
#include "sharing/vertex_sharing.hpp"

namespace octetra::distributed {

Migration unmoved(const DistributedMesh& mesh) {
    return {mesh.processes, mesh.cells.size(), mesh.points.size()};
}

Adaptation unchanged(const DistributedMesh& mesh) {
    return {.changed = false,
            .cells = EntityTransfer(mesh.cells.size()),
            .facets = EntityTransfer(mesh.facets.size()),
            .edges = EntityTransfer(mesh.edges.size()),
            .vertex_count_before = mesh.points.size(),
            .new_vertex_ends = {},
            .synchronisation = {}};
}

RefineOptions level_options(const StepOptions& options) {
    return {.scheme = options.scheme,
            .levels = 1,
            .synchronisation = options.synchronisation,
            .max_cells = options.max_cells,
            .is_last = options.is_last,
            .on_level = {}};
}

std::unique_ptr<AdaptiveMesh::State> AdaptiveMesh::State::make(DistributedMesh part) {
    const Communicator processes = part.processes;
    const Phase phase(processes, "sharers");
    return processes.transaction([&] {
        auto state = std::make_unique<State>();
        state->mesh = std::move(part);
        state->numbers = input_numbers(state->mesh);
        state->sharing = find_vertex_sharing(state->mesh);
        return state;
    });
}

Adaptation AdaptiveMesh::State::refine(const std::function<MarkedCells()>& mark,
                                       const StepOptions& options, const Tuning& tuning) {
    const StandardArithmetic standard;
    const int level = step_count + 1;
    const Phase phase(mesh.processes, "level", level);
    // Processes with different options refuse them in either branch.
    if (options.closure == Closure::regular)
        return refine_state_regularly(*this, mark, options, tuning);
    std::optional<NumberedLevel> numbered;
    mesh.processes.transaction([&] {
        check_same(mesh.processes, options);
        check_closure(*this, options);
        note_cells_before_level();
        PlannedLevel plan = plan_level(mesh, mark, level_options(options), tuning, level);
        if (plan.changes_anything()) numbered.emplace(*this, std::move(plan));
    });
    if (!numbered) return unchanged(mesh);
    mesh.closure = Closure::longest_edge;
    return numbered->commit();
}

void AdaptiveMesh::State::note_cells_before_level() const {
    if (Profile* const profile = mesh.processes.profile()) {
        profile->note_first_cells(step_count, mesh.cells.size());
    }
}

void AdaptiveMesh::State::replace_by(State&& after, std::unique_ptr<CellsAsRoots> roots) noexcept {
    after.forgotten = std::move(forgotten);
    if (roots != nullptr) after.forgotten.push_back(roots->keep());
    *this = std::move(after);
}

}  // namespace octetra::distributed
