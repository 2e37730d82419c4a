#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <octetra/distributed/adaptive_mesh.hpp>

#include "adapt/steps.hpp"

/// Steps as the library makes them. The lists of cells of their selections are complete.
namespace octetra::cli {

using OnLevel = std::function<void(int level, std::uint64_t cells)>;

/// Collective. Repeats marking and refining so often as the step says; what octetra refine does to
/// a mesh that has the same cells. A list of cells marks their descendants at later levels. Returns
/// how many levels changed anything. `on_level`, which may be empty, is told on the first process.
int refine(distributed::AdaptiveMesh& mesh, const RefineStep& step,
           const distributed::StepOptions& options, const OnLevel& on_level);

/// Collective. Repeats marking and coarsening. Returns how many levels changed anything.
int coarsen(distributed::AdaptiveMesh& mesh, const CoarsenStep& step, const OnLevel& on_level);

}  // namespace octetra::cli
