#pragma once

#include <utility>
#include <vector>

#include "history/coarsen.hpp"
#include "history/part_history.hpp"
#include "history/replay.hpp"
#include "level/planned_level.hpp"

namespace octetra::test {

using namespace distributed;

/// A mesh and what was done to it.
struct Recorded {
    DistributedMesh mesh;
    PartHistory history{mesh};
    int step_count = 0;

    /// Collective. One step.
    void refine(const Selection& selection, Scheme scheme, const Tuning& tuning) {
        PlannedLevel plan = plan_level(
            mesh, [&] { return mark_cells(mesh, selection, false); }, {.scheme = scheme}, tuning,
            ++step_count);
        if (!plan.changes_anything()) return;
        const std::vector<CellIndex> none;
        auto step =
            history.prepare(mesh.cells.size(), plan.level->cut_cells(), plan.order != nullptr,
                            plan.order ? plan.order->cells_before() : none);
        plan.commit();
        history.commit(std::move(step));
    }

    /// Collective. Takes back what the cells that the selection marks do not need.
    Coarser coarsen(const Selection& selection) {
        const std::vector<CutRuns> steps = history.steps(cells_in_order());
        restore_canonical_order(mesh);
        std::vector<std::uint8_t> may_go(mesh.cells.size(), 0);
        const MarkedCells marked = mark_cells(mesh, selection, false);
        if (marked.all) may_go.assign(may_go.size(), 1);
        for (const CellIndex c : marked.cells) may_go[c.value()] = 1;
        LocalFailure failure;
        Coarser coarser = distributed::coarsen(mesh, steps, may_go, failure);
        failure.agree(mesh.processes);
        DistributedMesh again = history.input_of(mesh);
        history = PartHistory(again, coarser.steps);
        replay(again, coarser.steps);
        mesh = std::move(again);
        return coarser;
    }

    /// The present cells' numbers in canonical order, or nothing where they are in this order.
    [[nodiscard]] std::vector<CellIndex> cells_in_order() {
        const CanonicalOrder order(mesh);
        return order.cells_before();
    }
};

}  // namespace octetra::test
