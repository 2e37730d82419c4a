#pragma once

#include <cstddef>

#include <octetra/distributed/distributed_mesh.hpp>

#include "history/cut_marks.hpp"
#include "history/cut_roots.hpp"
#include "level/planned_level.hpp"
#include "level/tuning.hpp"

namespace octetra::distributed {

/// Collective. Plans the next step of a history, of a mesh as it was before the step; level number
/// `level`, for messages. Nothing is closed, and of what is shared nothing is told. Throws as
/// plan_level() does.
[[nodiscard]] PlannedLevel plan_step(DistributedMesh& mesh, CutMarks& history, const Tuning& tuning,
                                     int level);

/// Collective. Cuts the cells of a part of the input step by step as its history of so many steps
/// says, which gives every number and bit that refinement gave; all parts together. Nothing is
/// closed, and of what is shared nothing is told. Throws as refine() does; the mesh is then what
/// the steps before made.
void replay(DistributedMesh& mesh, CutRoots history, std::size_t step_count,
            const Tuning& tuning = {});

}  // namespace octetra::distributed
