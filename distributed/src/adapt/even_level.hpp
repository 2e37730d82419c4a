#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <octetra/distributed/balance.hpp>
#include <octetra/distributed/migration.hpp>

#include "adapt/mesh_state.hpp"
#include "history/cells_as_roots.hpp"
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
    std::unique_ptr<CellsAsRoots> roots;    ///< likewise; null: they are those of before
    MarkedCells marks;                      ///< closed, in that order
    std::vector<int> rank_of_root;

    /// The mesh stays in this order, and its roots what they are.
    void keep_mesh() noexcept;
};

/// Collective. Nothing, on all processes, where the closed level is to be bisected as it is: it is
/// even enough, or would not become more so. Else the level is undone. `waited`: for how many cells
/// more than the mean all have waited until the process with most had made them, since cells moved;
/// this level adds to it. `known`: the numbers of the mesh's vertices, or null.
[[nodiscard]] std::optional<UnevenLevel> uneven_level(DistributedMesh& mesh, PlannedLevel& plan,
                                                      const BalanceOptions& balance,
                                                      const RefineOptions& options,
                                                      const Tuning& tuning, std::uint64_t& waited,
                                                      const CanonicalNumbers* known = nullptr);

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
