#pragma once

#include <span>

#include <octetra/distributed/distributed_mesh.hpp>

#include "history/cuts.hpp"
#include "level/planned_level.hpp"
#include "level/tuning.hpp"

namespace octetra::distributed {

/// Collective. Plans a step as its history says, of a mesh as it was before the step; level number
/// `level`, for messages. Nothing is closed, and of what is shared nothing is told. Throws as
/// plan_level() does.
[[nodiscard]] PlannedLevel plan_step(DistributedMesh& mesh, const CutRuns& step,
                                     const Tuning& tuning, int level);

/// Collective. Cuts the cells of a part of the input step by step as its history says, which gives
/// every number and bit that refinement gave; all parts together. Nothing is closed, and of what
/// is shared nothing is told. Throws as refine() does; the mesh is then what the steps before made.
void replay(DistributedMesh& mesh, std::span<const CutRuns> steps, const Tuning& tuning = {});

}  // namespace octetra::distributed
