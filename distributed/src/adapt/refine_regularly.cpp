#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <octetra/core/error.hpp>

#include "adapt/marks.hpp"
#include "adapt/mesh_state.hpp"
#include "adapt/step_options.hpp"
#include "level/incremental/adjacency.hpp"
#include "regular/regular_step.hpp"

namespace octetra::distributed {
namespace {

/// Lists all cells if all are marked.
MarkedCells listed(MarkedCells marked, std::size_t count) {
    if (!marked.all) return marked;
    marked.all = false;
    for (std::size_t c = 0; c < count; ++c) marked.cells.push_back(CellIndex{c});
    return marked;
}

}  // namespace

Adaptation refine_state_regularly(AdaptiveMesh::State& state,
                                  const std::function<MarkedCells()>& mark,
                                  const StepOptions& options, const Tuning& tuning) {
    DistributedMesh& mesh = state.mesh;
    std::optional<RegularStep> step;
    const bool changes_anything = mesh.processes.transaction([&] {
        check_same(mesh.processes, options);
        check_closure(state, options);
        const MarkedCells marked = listed(mark(), mesh.cells.size());
        if (!marked.edges.empty()) {
            throw InputError("edges cannot be marked with the regular closure, only cells");
        }
        return step.emplace(state, level_options(options), tuning).plan(marked);
    });
    if (!changes_anything) return unchanged(mesh);
    return step->commit();
}

EvenStep refine_state_evenly_and_regularly(AdaptiveMesh::State& state,
                                           const std::function<MarkedCells()>& mark,
                                           const BalanceOptions& balance,
                                           const StepOptions& options) {
    std::vector<std::uint8_t> marks;
    state.mesh.processes.transaction([&] {
        check_same(state.mesh.processes, options);
        check_closure(state, options);
        check_same(state.mesh.processes, balance);
        const MarkedCells marked = listed(mark(), state.mesh.cells.size());
        marks.resize(state.mesh.cells.size(), 0);
        for (const CellIndex c : marked.cells) marks[c.value()] = 1;
    });
    Migration move = rebalance_state(state, balance);
    marks = move.cells(std::move(marks));
    const auto moved_marks = [&] { return marked_by_bytes(state.mesh, marks); };
    return {std::move(move), state.refine(moved_marks, options)};
}

}  // namespace octetra::distributed
