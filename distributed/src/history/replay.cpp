#include "history/replay.hpp"

#include <utility>

namespace octetra::distributed {

PlannedLevel plan_step(DistributedMesh& mesh, CutMarks& history, const Tuning& tuning, int level) {
    const auto mark = [&] {
        return history.next_is_uniform(mesh) ? history.next_of_all(mesh) : history.next(mesh);
    };
    return plan_closed_level(mesh, mark, tuning, level);
}

void replay(DistributedMesh& mesh, CutRoots history, std::size_t step_count, const Tuning& tuning) {
    CutMarks marks(std::move(history));
    for (std::size_t t = 0; t < step_count; ++t) {
        plan_step(mesh, marks, tuning, static_cast<int>(t) + 1).commit();
    }
}

}  // namespace octetra::distributed
