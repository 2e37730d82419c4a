#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <octetra/distributed/adaptive_mesh.hpp>

#include "adapt/steps.hpp"

/// Steps as the library makes them. The lists of cells of their selections are complete.
namespace octetra::cli {

/// Who is told of each level that changed anything; functions may be empty.
struct Followers {
    std::function<void(int level, std::uint64_t cells)> on_level;  ///< on the first process
    std::function<void(const distributed::Adaptation&)> on_step;   ///< on all; collective
    std::function<void(const distributed::Migration&)> on_move;    ///< before a step; the same
    bool is_refined_before = false;  ///< had the mesh steps behind it already?
};

/// Collective. Repeats marking and refining so often as the step says; what octetra refine does to
/// a mesh that has the same cells. A list of cells marks their descendants at later levels. Returns
/// how many levels changed anything. `balance` says whether cells move before a level.
int refine(distributed::AdaptiveMesh& mesh, const RefineStep& step,
           const distributed::StepOptions& options,
           const std::optional<distributed::BalanceOptions>& balance, const Followers& followers);

/// Collective. Repeats marking and coarsening. Returns how many levels changed anything, and
/// whether the last one marked any cell at all.
int coarsen(distributed::AdaptiveMesh& mesh, const CoarsenStep& step, const Followers& followers,
            bool& is_any_marked);

}  // namespace octetra::cli
