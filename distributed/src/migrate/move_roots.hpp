#pragma once

#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/mesh_part.hpp>

#include "comm/local_failure.hpp"
#include "history/cut_roots.hpp"

namespace octetra::distributed {

/// What a process has when cells of the input, the roots, have gone to others.
struct MovedRoots {
    MeshPart input;              ///< its cells ascend by number
    CutRoots cuts;               ///< what the steps did to them
    std::vector<int> came_from;  ///< of each cell, the process that had it
};

/// Collective. Of a mesh in canonical order: each root goes to the process that `rank_of_root`
/// names, with what it was given in the input and what the steps, `cuts`, did to it; a tagged facet
/// or edge goes where the first cell goes that has it. Vertices of no cell stay. Where a process
/// has failed or fails, the result is not to be used on any.
[[nodiscard]] MovedRoots move_roots(const DistributedMesh& mesh, const CutRoots& cuts,
                                    std::span<const int> rank_of_root, LocalFailure& failure);

}  // namespace octetra::distributed
