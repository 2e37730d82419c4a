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

/// Returns the map from the entities after a step to those before it. `before` has their numbers
/// outside the canonical order, or is empty if these are the same.
template <class I>
EntityTransfer transfer_of(Descent descent, const std::vector<I>& before, std::size_t count) {
    if (!before.empty()) {
        for (std::uint32_t& number : descent.before) number = before[number].value();
    }
    return EntityTransfer::of_parents(count, std::move(descent.before),
                                      std::move(descent.halvings));
}

Adaptation adaptation_of(RegularStep& step, const CanonicalOrder& order,
                         const DistributedMesh& before) {
    return {
        .changed = true,
        .cells = transfer_of(std::move(step.cells), order.cells_before(), before.cells.size()),
        .facets = transfer_of(std::move(step.facets), order.facets_before(), before.facets.size()),
        .edges = transfer_of(std::move(step.edges), order.edges_before(), before.edges.size()),
        .vertex_count_before = before.points.size(),
        .new_vertex_ends = std::move(step.new_vertex_ends),
        .vertices_before = std::move(step.vertices_before),
        .removed_vertices = {},
        .synchronisation = step.counts};
}

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
                                  const StepOptions& options) {
    DistributedMesh& mesh = state.mesh;
    std::optional<CanonicalOrder> order;
    std::unique_ptr<AdaptiveMesh::State> after;
    Adaptation adaptation;
    mesh.processes.transaction([&] {
        check_same(mesh.processes, options);
        check_closure(state, options);
        MarkedCells marked = listed(mark(), mesh.cells.size());
        if (!marked.edges.empty()) {
            throw InputError("edges cannot be marked with the regular closure, only cells");
        }
        order.emplace(mesh);
        marked = renumbered(std::move(marked), order->cells_before());
        RegularStep step = regular_step(mesh, marked, level_options(options));
        if (!step.changes_anything) return;
        adaptation = adaptation_of(step, *order, mesh);
        step.mesh.closure = Closure::regular;
        after = state_of(step.mesh);
    });
    if (after == nullptr) return unchanged(mesh);
    order->keep();
    order.reset();
    after->accumulated_idle = state.accumulated_idle;
    state.replace_by(std::move(*after), nullptr);
    return adaptation;
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
