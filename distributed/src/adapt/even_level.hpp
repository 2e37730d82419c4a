#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <octetra/distributed/balance.hpp>
#include <octetra/distributed/migration.hpp>

#include "adapt/mesh_state.hpp"
#include "level/incremental/adjacency.hpp"
#include "level/planned_level.hpp"

/// Roots that move between closure and bisection: how many cells each becomes is known then, and
/// what moves is small yet. The idea is that of PLUM (Oliker and Biswas), without its error of
/// prediction.
namespace octetra::distributed {

/// What is to be done first of a level that would leave processes with too different numbers of
/// cells.
struct UnevenLevel {
    std::unique_ptr<CanonicalOrder> order;  ///< that the mesh is in as long as this lives
    MarkedCells marks;                      ///< closed, in that order
    std::vector<int> rank_of_root;
};

/// Collective. Nothing, on all processes, where the closed level is to be bisected as it is: it is
/// even enough, or would not become more so. Else the level is undone.
[[nodiscard]] std::optional<UnevenLevel> uneven_level(DistributedMesh& mesh, PlannedLevel& plan,
                                                      const BalanceOptions& balance,
                                                      const RefineOptions& options,
                                                      const Tuning& tuning);

struct MovedLevel {
    std::unique_ptr<AdaptiveMesh::State> state;
    Migration migration;
    PlannedLevel plan;  ///< of that state's mesh, closed
};

/// Collective. The level, of a state in the order that it is in, with roots where they are to be.
/// The state stays as it is.
[[nodiscard]] MovedLevel moved_level(const AdaptiveMesh::State& state, const UnevenLevel& level,
                                     const RefineOptions& options, const Tuning& tuning);

}  // namespace octetra::distributed
