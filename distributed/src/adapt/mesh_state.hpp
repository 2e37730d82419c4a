#pragma once

#include <functional>
#include <memory>

#include <octetra/distributed/adaptive_mesh.hpp>

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
    int step_count = 0;

    State() = default;
    /// Collective. Of a part that is as the input was.
    explicit State(DistributedMesh part);

    /// Collective.
    Adaptation refine(const std::function<MarkedCells()>& mark, const StepOptions& options,
                      const Tuning& tuning = {});
};

/// What a step that changes nothing did.
[[nodiscard]] Adaptation unchanged(const DistributedMesh& mesh);

/// Collective. Lets marked cells go back by a generation.
[[nodiscard]] Adaptation coarsen_state(AdaptiveMesh::State& state,
                                       const std::function<MarkedCells()>& mark,
                                       const Tuning& tuning = {});

/// Collective. Each root of this process goes to the process named.
[[nodiscard]] Migration migrate_state(AdaptiveMesh::State& state,
                                      std::span<const int> rank_of_root);

/// Collective. Moves roots where processes have too different numbers of cells.
[[nodiscard]] Migration rebalance_state(AdaptiveMesh::State& state, const BalanceOptions& options);

}  // namespace octetra::distributed
