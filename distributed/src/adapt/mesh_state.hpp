#pragma once

#include <functional>
#include <memory>

#include <octetra/distributed/adaptive_mesh.hpp>

#include "history/part_history.hpp"
#include "level/planned_level.hpp"
#include "mark/marked_cells.hpp"
#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// An AdaptiveMesh from inside: the mesh, what is known of it, and what was done to it. All that
/// is collective throws alike on all processes, and changes nothing then.
struct AdaptiveMesh::State {
    DistributedMesh mesh;
    CanonicalNumbers numbers;
    Sharing<VertexIndex> sharing;
    PartHistory history;
    int step_count = 0;

    /// Collective. Of a part that is as the input was.
    explicit State(DistributedMesh part);
    /// The same, of vertices shared so, which is going to be cut by these steps: see replay().
    State(DistributedMesh part, Sharing<VertexIndex> shared, std::vector<CutRuns> steps);

    /// Collective.
    Adaptation refine(const std::function<MarkedCells()>& mark, const StepOptions& options);
    /// Collective. Cuts the input by the steps that the history has. Leaves the mesh in canonical
    /// order.
    void replay();

private:
    /// Collective. Commits the level when all is made ready, `prepare` called on each process. (Not
    /// a std::function, which one process alone may have no memory for.)
    void commit(PlannedLevel& plan, auto&& prepare);
    [[nodiscard]] PartHistory::NewStep recorded(PlannedLevel& plan);
};

/// What a step that changes nothing did.
[[nodiscard]] Adaptation unchanged(const DistributedMesh& mesh);

/// Collective. Lets marked cells go back by a generation: a new state takes the place of the old.
[[nodiscard]] Adaptation coarsen_state(std::unique_ptr<AdaptiveMesh::State>& state,
                                       const std::function<MarkedCells()>& mark);

}  // namespace octetra::distributed
