#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>

#include "history/cells_as_roots.hpp"
#include "history/history.hpp"
#include "level/planned_level.hpp"
#include "mark/marked_cells.hpp"
#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// An AdaptiveMesh from inside: the mesh, what is known of it, and how many steps it took. All
/// that is collective throws alike on all processes, and changes nothing then.
struct AdaptiveMesh::State {
    DistributedMesh mesh;
    CanonicalNumbers numbers;
    Sharing<VertexIndex> sharing;
    int step_count = 0;        ///< those that were forgotten, too
    std::uint64_t waited = 0;  ///< see uneven_level()
    /// Of each time that cells became roots what this process's part was before.
    std::vector<History> forgotten;

    State() = default;
    /// Collective. Of a part that is as the input was.
    [[nodiscard]] static std::unique_ptr<State> make(DistributedMesh part);

    /// Collective.
    Adaptation refine(const std::function<MarkedCells()>& mark, const StepOptions& options,
                      const Tuning& tuning = {});
    /// Collective. What a level of this mesh brings, once it is ready to be committed. The level is
    /// committed then.
    Adaptation take(PlannedLevel& plan);
    /// For a profile, before the first level that is in it.
    void note_cells_before_level() const;
    /// Collective. For the part that `roots` have, before move_on().
    void make_room_for_history();
    /// Goes on as `after`, which is this state with cells that moved; `roots`, or null: they are
    /// roots since.
    void move_on(State&& after, std::unique_ptr<CellsAsRoots> roots) noexcept;
};

[[nodiscard]] RefineOptions level_options(const StepOptions& options);

/// What a step that changes nothing did.
[[nodiscard]] Adaptation unchanged(const DistributedMesh& mesh);
/// Of a move that leaves everything where it is.
[[nodiscard]] Migration unmoved(const DistributedMesh& mesh);

/// Collective. A step before which roots move, if processes would have too different numbers of
/// cells.
[[nodiscard]] EvenStep refine_state_evenly(AdaptiveMesh::State& state,
                                           const std::function<MarkedCells()>& mark,
                                           const BalanceOptions& balance,
                                           const StepOptions& options, const Tuning& tuning = {});

/// Collective. Lets marked cells go back by a generation.
[[nodiscard]] Adaptation coarsen_state(AdaptiveMesh::State& state,
                                       const std::function<MarkedCells()>& mark,
                                       const Tuning& tuning = {});

/// Collective. Each root of this process goes to the process named.
[[nodiscard]] Migration migrate_state(AdaptiveMesh::State& state,
                                      std::span<const int> rank_of_root);

/// Collective. The state with each root of this process at the process named, of one in canonical
/// order; each cell had the number that `cells_outside` says, or had the same if that is empty.
[[nodiscard]] std::optional<AdaptiveMesh::State> moved_state(
    const AdaptiveMesh::State& state, std::span<const CellIndex> cells_outside,
    std::span<const int> rank_of_root, Migration& migration);

/// Collective. The state of a mesh that has its history and nothing beyond it; in canonical order.
[[nodiscard]] std::optional<AdaptiveMesh::State> state_of(DistributedMesh& mesh);

/// Collective. Moves roots where processes have too different numbers of cells.
[[nodiscard]] Migration rebalance_state(AdaptiveMesh::State& state, const BalanceOptions& options);

/// Collective. The roots are what they were before cells became roots, if they ever did; the last
/// time that they did is taken back.
[[nodiscard]] Migration recall_history(AdaptiveMesh::State& state);

}  // namespace octetra::distributed
