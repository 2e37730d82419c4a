#include "level/planned_level.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/profile.hpp>

#include "level/full_sweep/full_sweep_level.hpp"
#include "level/incremental/incremental_level.hpp"
#include "level/incremental/suits_incremental_level.hpp"
#include "level/synchronise.hpp"

namespace octetra::distributed {
namespace {

/// Throws if this process would have more entities than 32-bit numbers can represent.
void check_countable(std::size_t count, const char* what) {
    if (count < VertexIndex::limit) return;
    throw InputError(fmt::format("the refined mesh would have more than {} {} on one process",
                                 VertexIndex::limit, what));
}

/// Collective. Throws if the whole mesh would have more cells than allowed.
void check_allowed(const DistributedMesh& mesh, std::size_t count, const RefineOptions& options,
                   int level) {
    if (options.max_cells == std::numeric_limits<std::uint64_t>::max()) return;
    const std::uint64_t cells = mesh.processes.sum(count);
    if (cells <= options.max_cells) return;
    throw InputError(
        fmt::format("level {} would make {} cells, more than the {} allowed: mark fewer cells or "
                    "levels, or allow more",
                    level, cells, options.max_cells));
}

/// Collective. Closes the marked edges.
SynchronisationCounts close(MarkedEdges& closure, const DistributedMesh& mesh,
                            const RefineOptions& options) {
    const Phase phase(mesh.processes, "synchronise");
    return options.synchronisation == Synchronisation::neighbour
               ? synchronise_by_neighbours(closure, mesh)
               : synchronise_by_gateway(closure, mesh);
}

template <class I>
std::vector<std::uint32_t> numbers_of(const std::vector<I>& list) {
    std::vector<std::uint32_t> numbers(list.size());
    std::ranges::transform(list, numbers.begin(), &I::value);
    return numbers;
}

}  // namespace

ListChanges PlannedLevel::changes() {
    ListChanges changes = level->changes();
    if (order == nullptr) return changes;
    changes.cells.set_order(numbers_of(order->cells_before()));
    changes.facets.set_order(numbers_of(order->facets_before()));
    changes.edges.set_order(numbers_of(order->edges_before()));
    return changes;
}

MarkedCells renumbered(MarkedCells marked, const std::vector<CellIndex>& before) {
    if (marked.all || before.empty()) return marked;
    constexpr std::uint32_t unmarked = CellIndex::none_value;
    std::vector<std::uint32_t> position(before.size(), unmarked);  // in the list of marked cells
    for (std::size_t k = 0; k < marked.cells.size(); ++k) {
        position[marked.cells[k].value()] = static_cast<std::uint32_t>(k);
    }
    MarkedCells after{.count = marked.count, .tested = marked.tested};
    for (std::size_t c = 0; c < before.size(); ++c) {
        const std::uint32_t k = position[before[c].value()];
        if (k == unmarked) continue;
        after.cells.push_back(CellIndex{c});
        if (!marked.edges.empty()) after.edges.push_back(marked.edges[k]);
    }
    return after;
}

void begin_level(DistributedMesh& mesh, const RefineOptions& options, const Tuning& tuning,
                 MarkedCells marked, PlannedLevel& plan, const TransitionCells* transition) {
    if (suits_incremental_level(mesh, marked, tuning, options.is_last)) {
        auto level = std::make_unique<IncrementalLevel>(mesh, transition);
        const Phase phase(mesh.processes, "select");
        level->mark(marked, options.scheme);
        plan.level = std::move(level);
        return;
    }
    if (mesh.adjacency != nullptr) {
        const Phase phase(mesh.processes, "select");
        plan.order = std::make_unique<CanonicalOrder>(mesh);
        marked = renumbered(std::move(marked), plan.order->cells_before());
    }
    const double local_below = transition == nullptr ? tuning.local_below : 0;
    auto level = std::make_unique<FullSweepLevel>(mesh, marked, local_below, transition);
    const Phase phase(mesh.processes, "select");
    level->mark(marked, options.scheme);
    plan.level = std::move(level);
}

PlannedLevel close_level(DistributedMesh& mesh, const std::function<MarkedCells()>& mark_cells,
                         const RefineOptions& options, const Tuning& tuning,
                         const TransitionCells* transition) {
    const Communicator& processes = mesh.processes;
    MarkedCells marked = in_phase(processes, "select", mark_cells);
    PlannedLevel plan;
    plan.tested = marked.tested;
    if (processes.max(marked.count) == 0) return plan;
    begin_level(mesh, options, tuning, std::move(marked), plan, transition);
    plan.counts = close(plan.level->closure(), mesh, options);
    return plan;
}

void bisect_level(PlannedLevel& plan, const DistributedMesh& mesh, const RefineOptions& options,
                  int level) {
    Level& planned = *plan.level;
    {
        const Phase phase(mesh.processes, "bisect edges");
        check_countable(mesh.points.size() + planned.closure().marked_count(), "vertices");
        planned.bisect_edges();
    }
    RoundingFailure rounding;
    {
        const Phase phase(mesh.processes, "bisect tetrahedra");
        const std::size_t cell_count = planned.cell_count_afterwards();
        check_countable(cell_count, "cells");
        check_allowed(mesh, cell_count, options, level);
        rounding = planned.bisect_cells(cell_count);
        if (!rounding.found()) planned.bisect_tagged();
    }
    const Phase phase(mesh.processes, "interfaces");
    if (!rounding.found()) planned.bisect_interfaces();
    rounding.agree(mesh, level);
}

PlannedLevel plan_level(DistributedMesh& mesh, const std::function<MarkedCells()>& mark_cells,
                        const RefineOptions& options, const Tuning& tuning, int level) {
    PlannedLevel plan = close_level(mesh, mark_cells, options, tuning);
    if (plan.changes_anything()) bisect_level(plan, mesh, options, level);
    return plan;
}

PlannedLevel plan_closed_level(DistributedMesh& mesh,
                               const std::function<MarkedCells()>& mark_cells, const Tuning& tuning,
                               int level, const RefineOptions& options) {
    PlannedLevel plan;
    begin_level(mesh, options, tuning, mark_cells(), plan);
    bisect_level(plan, mesh, options, level);
    return plan;
}

}  // namespace octetra::distributed
