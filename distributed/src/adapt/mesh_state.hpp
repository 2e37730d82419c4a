#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>

#include "history/cells_as_roots.hpp"
#include "history/history.hpp"
#include "level/incremental/adjacency.hpp"
#include "level/marked_cells.hpp"
#include "level/planned_level.hpp"
#include "level/transition_cells.hpp"
#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// The implementation of AdaptiveMesh: the mesh, its numbering and sharing, and the number of
/// steps. Collective functions throw the same on all processes and leave the state unchanged then.
struct AdaptiveMesh::State {
    DistributedMesh mesh;
    CanonicalNumbers numbers;
    Sharing<VertexIndex> sharing;
    int step_count = 0;                  ///< including forgotten steps
    std::uint64_t accumulated_idle = 0;  ///< see uneven_level()
    /// The kinds of the cells if the mesh was refined with Closure::regular, unless they are
    /// unknown: then empty.
    TransitionCells::Kinds transition_kinds;
    /// The history of this process's part before each time that cells became roots.
    std::vector<History> forgotten;

    State() = default;
    /// Collective. Creates the state of an unrefined part.
    [[nodiscard]] static std::unique_ptr<State> make(DistributedMesh part);

    /// Collective. Performs a step.
    Adaptation refine(const std::function<MarkedCells()>& mark, const StepOptions& options,
                      const Tuning& tuning = {});
    /// Records the number of cells before the first level of a profile.
    void note_cells_before_level() const;
    /// Replaces *this by `after`, the state after migration. If `roots` is not null, cells have
    /// become the roots, and the previous history is added to `forgotten`, which must have capacity
    /// for it.
    void replace_by(State&& after, std::unique_ptr<CellsAsRoots> roots) noexcept;
};

[[nodiscard]] RefineOptions level_options(const StepOptions& options);

/// Returns the description of a step that changes nothing.
[[nodiscard]] Adaptation unchanged(const DistributedMesh& mesh);
/// Returns a migration in which nothing moves.
[[nodiscard]] Migration unmoved(const DistributedMesh& mesh);

/// Collective. Performs a step, preceded by a migration of roots if the processes would have too
/// different numbers of cells.
[[nodiscard]] EvenStep refine_state_evenly(AdaptiveMesh::State& state,
                                           const std::function<MarkedCells()>& mark,
                                           const BalanceOptions& balance,
                                           const StepOptions& options, const Tuning& tuning = {});

/// Collective. Performs a step with Closure::regular.
[[nodiscard]] Adaptation refine_state_regularly(AdaptiveMesh::State& state,
                                                const std::function<MarkedCells()>& mark,
                                                const StepOptions& options,
                                                const Tuning& tuning = {});

/// Collective. The same, preceded by a migration of roots if the processes have too different
/// numbers of cells before the step.
[[nodiscard]] EvenStep refine_state_evenly_and_regularly(AdaptiveMesh::State& state,
                                                         const std::function<MarkedCells()>& mark,
                                                         const BalanceOptions& balance,
                                                         const StepOptions& options,
                                                         const Tuning& tuning = {});

/// Collective. Coarsens marked cells by one generation.
[[nodiscard]] Adaptation coarsen_state(AdaptiveMesh::State& state,
                                       const std::function<MarkedCells()>& mark,
                                       const Tuning& tuning = {});

/// Collective. Migrates each root of this process to the given rank.
[[nodiscard]] Migration migrate_state(AdaptiveMesh::State& state,
                                      std::span<const int> rank_of_root);

/// The state after a migration.
struct MovedState {
    std::unique_ptr<AdaptiveMesh::State> state;  ///< null if nothing moves
    Migration migration;
};

/// Collective, within a transaction. Returns the state after the migration of each root of this
/// process to the given rank; `state` itself is unchanged. The mesh must be in canonical order;
/// `unordered_cell_ids` has the number of each cell outside that order, or is empty if it is the
/// same.
[[nodiscard]] MovedState moved_state(const AdaptiveMesh::State& state,
                                     std::span<const CellIndex> unordered_cell_ids,
                                     std::span<const int> rank_of_root);

/// Collective, within a transaction. Moves a mesh that has only its history, in canonical order,
/// into a state. The mesh is unchanged if this throws on any process.
[[nodiscard]] std::unique_ptr<AdaptiveMesh::State> state_of(DistributedMesh& mesh);

/// A migration of roots that makes the numbers of cells of the processes more even.
struct EvenMigration {
    std::unique_ptr<CanonicalOrder> order;  ///< the order of the mesh while this exists
    std::unique_ptr<CellsAsRoots> roots;    ///< likewise its roots, or null if unchanged
    MovedState to;                          ///< the state is null if nothing moves

    /// Replaces the state by `to`, if anything moves. Returns the migration.
    [[nodiscard]] Migration commit(AdaptiveMesh::State& state) noexcept;
};

/// Collective, within a transaction. Returns the migration of roots if the processes have too
/// different numbers of cells. Only the order and the roots of the mesh change, as long as the
/// result exists.
[[nodiscard]] EvenMigration even_migration(AdaptiveMesh::State& state,
                                           const BalanceOptions& balance);

/// Collective. Migrates roots if the processes have too different numbers of cells.
[[nodiscard]] Migration rebalance_state(AdaptiveMesh::State& state, const BalanceOptions& options);

/// Collective. Restores the roots that the mesh had before cells became roots the last time, if
/// they ever did.
[[nodiscard]] Migration recall_history(AdaptiveMesh::State& state);

}  // namespace octetra::distributed
