#include "history/replay.hpp"

namespace octetra::distributed {
namespace {

/// The cells that a step cuts, and the edges.
MarkedCells marked_by(const CutRuns& step) {
    MarkedCells marked;
    std::size_t cell = 0;
    for_each_run(step, [&](Cut cut, std::uint64_t count) {
        const std::size_t end = cell + count;
        if (cut == 0) {
            cell = end;
            return;
        }
        marked.edges.insert(marked.edges.end(), count, edges_of(cut));
        for (; cell < end; ++cell) marked.cells.push_back(CellIndex{cell});
    });
    marked.count = marked.cells.size();
    return marked;
}

}  // namespace

PlannedLevel plan_step(DistributedMesh& mesh, const CutRuns& step, const Tuning& tuning,
                       int level) {
    const auto mark = [&] {
        restore_canonical_order(mesh);
        return marked_by(step);
    };
    return plan_closed_level(mesh, mark, tuning, level);
}

void replay(DistributedMesh& mesh, std::span<const CutRuns> steps, const Tuning& tuning) {
    int level = 0;
    for (const CutRuns& step : steps) plan_step(mesh, step, tuning, ++level).commit();
}

}  // namespace octetra::distributed
