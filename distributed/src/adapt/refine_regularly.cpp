#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <octetra/core/error.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/marks.hpp"
#include "adapt/mesh_state.hpp"
#include "adapt/step_options.hpp"
#include "level/incremental/adjacency.hpp"
#include "regular/regular_step.hpp"

namespace octetra::distributed {
namespace {

/// Collective, within a transaction. Checks the options and returns the list of marked cells.
MarkedCells listed_cells(const AdaptiveMesh::State& state, const std::function<MarkedCells()>& mark,
                         const StepOptions& options) {
    check_same(state.mesh.processes, options);
    check_closure(state, options);
    MarkedCells marked = mark();
    if (!marked.edges.empty()) {
        throw InputError("edges cannot be marked with the regular closure, only cells");
    }
    if (!marked.all) return marked;
    marked.all = false;
    for (std::size_t c = 0; c < state.mesh.cells.size(); ++c) marked.cells.push_back(CellIndex{c});
    return marked;
}

/// The same cells after a migration.
MarkedCells moved_cells(const MarkedCells& marked, const AdaptiveMesh::State& state,
                        const MovedState& to) {
    std::vector<std::uint8_t> marks(state.mesh.cells.size(), 0);
    for (const CellIndex c : marked.cells) marks[c.value()] = 1;
    return marked_by_bytes(to.state->mesh, to.migration.cells(std::move(marks)));
}

}  // namespace

Adaptation refine_state_regularly(AdaptiveMesh::State& state,
                                  const std::function<MarkedCells()>& mark,
                                  const StepOptions& options, const Tuning& tuning) {
    DistributedMesh& mesh = state.mesh;
    std::optional<RegularStep> step;
    const bool changes_anything = mesh.processes.transaction([&] {
        const MarkedCells marked = listed_cells(state, mark, options);
        return step.emplace(state, level_options(options), tuning).plan(marked);
    });
    if (!changes_anything) return unchanged(mesh);
    return step->commit();
}

EvenStep refine_state_evenly_and_regularly(AdaptiveMesh::State& state,
                                           const std::function<MarkedCells()>& mark,
                                           const BalanceOptions& balance,
                                           const StepOptions& options, const Tuning& tuning) {
    const Communicator processes = state.mesh.processes;
    const Phase phase(processes, "level", state.step_count + 1);
    EvenMigration even;
    std::optional<RegularStep> step;  // of the moved state, if there is one
    const bool changes_anything = processes.transaction([&] {
        check_same(processes, balance);
        MarkedCells marked = listed_cells(state, mark, options);
        even = even_migration(state, balance);
        if (even.to.state != nullptr) marked = moved_cells(marked, state, even.to);
        AdaptiveMesh::State& of_step = even.to.state != nullptr ? *even.to.state : state;
        return step.emplace(of_step, level_options(options), tuning).plan(marked);
    });
    if (!changes_anything) step.reset();
    EvenStep done;
    if (step) done.step = step->commit();
    step.reset();
    done.move = even.commit(state);
    if (!changes_anything) done.step = unchanged(state.mesh);
    return done;
}

}  // namespace octetra::distributed
