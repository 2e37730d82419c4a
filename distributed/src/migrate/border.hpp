#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// The entities that a part shares with another process, after all steps.
struct BorderWith {
    Interface interface;                 ///< ascending by vertices on both processes
    std::vector<VertexIndex> midpoints;  ///< of shared edges, ascending
};

/// Derives the border after all steps from the shared edges and faces of the input and the
/// midpoints of the mesh. Both sides derive equal lists, because the order of their vertices is the
/// same. Takes time proportional to the border, plus one pass over the midpoints. Not collective.
[[nodiscard]] std::vector<BorderWith> border_after_steps(const DistributedMesh& mesh,
                                                         const std::vector<Interface>& of_input);

}  // namespace octetra::distributed
