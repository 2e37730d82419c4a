#pragma once

#include <cstddef>

#include <octetra/distributed/distributed_mesh.hpp>

#include "history/cut_marks.hpp"
#include "history/cut_roots.hpp"
#include "level/planned_level.hpp"
#include "level/tuning.hpp"

namespace octetra::distributed {

/// Collective. Plans the next step of a history, on the mesh as it was before that step. `level` is
/// the number of the level in messages. Computes no closure and exchanges no marks. Throws as
/// plan_level() does.
[[nodiscard]] PlannedLevel plan_step(DistributedMesh& mesh, CutMarks& history, const Tuning& tuning,
                                     int level);

/// Collective. Refines the part of the input by the first `step_count` steps of its history, on all
/// processes together. The result has the same numbers and bits as the original refinement.
/// Computes no closure and exchanges no marks. Throws as refine() does; the mesh then has the steps
/// before the failed one.
void replay(DistributedMesh& mesh, CutRoots history, std::size_t step_count,
            const Tuning& tuning = {});

}  // namespace octetra::distributed
