#include "adapt/numbered_level.hpp"

#include <span>
#include <utility>
#include <vector>

#include <octetra/core/huge_pages.hpp>
#include <octetra/distributed/profile.hpp>

namespace octetra::distributed {
namespace {

/// Describes a level; to be called before it is committed.
Adaptation adaptation_of(PlannedLevel& plan, const DistributedMesh& mesh) {
    const std::size_t before = mesh.level_begin.back().value();
    const auto new_ends = midpoint_ends(mesh, mesh.level_begin.size() - 1);
    std::vector<EdgeVertices> copied;
    reserve_in_huge_pages(copied, new_ends.size());
    copied.assign(new_ends.begin(), new_ends.end());
    ListChanges changes = plan.changes();
    return {.changed = true,
            .cells = std::move(changes.cells),
            .facets = std::move(changes.facets),
            .edges = std::move(changes.edges),
            .vertex_count_before = before,
            .new_vertex_ends = std::move(copied),
            .synchronisation = plan.counts};
}

}  // namespace

NumberedLevel::NumberedLevel(AdaptiveMesh::State& state, PlannedLevel plan)
    : state_(&state),
      plan_(std::move(plan)),
      new_numbers_(state.numbers),
      shared_(state.sharing, state.mesh.processes.rank()) {
    const DistributedMesh& mesh = state.mesh;
    {
        const Phase phase(mesh.processes, "number vertices");
        state.numbers.number_midpoints(mesh.processes,
                                       midpoint_ends(mesh, mesh.level_begin.size() - 1),
                                       state.sharing.shared());
    }
    {
        const Phase phase(mesh.processes, "sharers");
        auto midpoints = plan_.level->shared_midpoints();
        for (std::size_t i = 0; i < midpoints.size(); ++i) {
            shared_.share(mesh.interfaces[i].rank, std::move(midpoints[i]));
        }
        shared_.prepare(
            [&](VertexIndex v) { return static_cast<std::uint64_t>(state.numbers.of_vertex[v]); });
    }
    const Phase phase(mesh.processes, "maps");
    adaptation_ = adaptation_of(plan_, mesh);
    note_cells(mesh.processes, state.step_count + 1, plan_.level->cell_count_afterwards(),
               plan_.tested + plan_.level->cells_touched());
}

Adaptation NumberedLevel::commit() noexcept {
    plan_.commit();
    shared_.commit();
    new_numbers_.keep();
    ++state_->step_count;
    return std::move(adaptation_);
}

}  // namespace octetra::distributed
