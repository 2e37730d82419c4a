#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// What a part shares with another process, after all steps.
struct BorderWith {
    Interface interface;                 ///< in ascending order of the vertices, here as there
    std::vector<VertexIndex> midpoints;  ///< of shared edges, ascending
};

/// What became of the shared edges and faces of the input, by the midpoints that there are. Both
/// sides come to equal lists, as the order of their vertices is the same. Takes time in proportion
/// to the border, but for one pass over the midpoints. Not collective.
[[nodiscard]] std::vector<BorderWith> border_after_steps(const DistributedMesh& mesh,
                                                         const std::vector<Interface>& of_input);

}  // namespace octetra::distributed
