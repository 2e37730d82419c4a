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

/// Migration of roots between closure and bisection, when the number of cells of each root after
/// the level is known, and the data to migrate are still small. The idea is that of PLUM (Oliker
/// and Biswas), without its prediction error.
namespace octetra::distributed {

/// A level that would leave the processes with uneven numbers of cells, and the migration that is
/// to precede it.
struct UnevenLevel {
    std::unique_ptr<CanonicalOrder> order;  ///< the order of the mesh while this exists
    std::unique_ptr<CellsAsRoots> roots;    ///< likewise its roots, or null if unchanged
    MarkedCells marks;                      ///< closed, in that order
    std::vector<int> rank_of_root;

    /// Makes the order and the roots of the mesh permanent.
    void keep_mesh() noexcept;
};

/// Collective, within a transaction. Returns nothing on all processes if the closed level is to be
/// bisected without migration, because it is even enough or would not become more so; otherwise
/// undoes the level.
/// `accumulated_idle`: the sum over uneven levels since the last migration of the cells by which
/// the most loaded process exceeded the mean, while the others were idle; this level adds to it.
/// `known`: the global numbers of the mesh's vertices, or null.
[[nodiscard]] std::optional<UnevenLevel> uneven_level(DistributedMesh& mesh, PlannedLevel& plan,
                                                      const BalanceOptions& balance,
                                                      const RefineOptions& options,
                                                      const Tuning& tuning,
                                                      std::uint64_t& accumulated_idle,
                                                      const CanonicalNumbers* known = nullptr);

struct MovedLevel {
    MovedState to;
    PlannedLevel plan;  ///< a closed level of the mesh of `to.state`
};

/// Collective, within a transaction. Migrates the roots of a state, in its current order, and
/// begins the level on the result. `state` itself is unchanged.
[[nodiscard]] MovedLevel moved_level(const AdaptiveMesh::State& state, const UnevenLevel& level,
                                     const RefineOptions& options, const Tuning& tuning);

}  // namespace octetra::distributed
