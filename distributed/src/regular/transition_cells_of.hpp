#pragma once

#include "level/transition_cells.hpp"

namespace octetra::distributed {

/// Returns the transition cells of a mesh that was refined with Closure::regular only and is in
/// canonical order. The result keeps a pointer to the mesh. Takes time proportional to the part.
/// Throws InputError if the mesh was refined otherwise. Not collective.
[[nodiscard]] TransitionCells transition_cells_of(const DistributedMesh& mesh);

/// Returns the generation of each vertex.
[[nodiscard]] TransitionCells::Generations generations_of(const DistributedMesh& mesh);

}  // namespace octetra::distributed
