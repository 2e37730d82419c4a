#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/fit.hpp>

#include "adapt/size_files.hpp"
#include "adapt/steps.hpp"

/// Steps carried out by the library. The lists of cells of their selections are complete.
namespace octetra::cli {

/// Callbacks for each level that changed the mesh; functions may be empty.
struct Followers {
    std::function<void(int level, std::uint64_t cells)> on_level;  ///< on the first process
    std::function<void(const distributed::Adaptation&)> on_step;   ///< on all processes; collective
    std::function<void(const distributed::Migration&)> on_move;    ///< before a step; likewise
    bool is_refined_before = false;  ///< whether the mesh already had a history
    /// The fields of the current mesh, for expressions; on_step and on_move must keep them so.
    const CarriedFields* fields = nullptr;
};

struct RefinedLevels {
    int count = 0;  ///< that changed the mesh
    /// With --target-cells: the numbers of cells that the last level marked, and of those that it
    /// refined; equal unless all would have made too many cells.
    std::uint64_t marked = 0;
    std::uint64_t refined = 0;
};

/// Collective. Repeats marking and refining as often as the step requests, with the same result as
/// octetra refine of a mesh with the same cells. A list of cells marks their descendants at later
/// levels. If `balance` is set, cells may move
/// before a level.
RefinedLevels refine(distributed::AdaptiveMesh& mesh, const RefineStep& step,
                     const distributed::StepOptions& options,
                     const std::optional<distributed::BalanceOptions>& balance,
                     const Followers& followers);

/// Collective. Repeats marking and coarsening. Returns the number of levels that changed the mesh,
/// and sets `is_any_marked` to whether the last one marked any cell.
int coarsen(distributed::AdaptiveMesh& mesh, const CoarsenStep& step, const Followers& followers,
            bool& is_any_marked);

struct Fitted {
    int refined = 0;  ///< levels that changed the mesh
    int coarsened = 0;
    distributed::MisfitCells misfits;
};

/// Collective. Fits the mesh to the target size. If `balance` is set, cells may move before a
/// level.
Fitted fit(distributed::AdaptiveMesh& mesh, const FitStep& step,
           const distributed::StepOptions& options,
           const std::optional<distributed::BalanceOptions>& balance, const Followers& followers);

}  // namespace octetra::cli
