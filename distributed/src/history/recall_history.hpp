#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "history/history.hpp"

/// How a mesh whose cells became roots gets back what it was before: roots go to where they were
/// cells then, where that part of the history is that they come from, and there they are
/// descendants again.
namespace octetra::distributed {

/// Collective. Of each root of this process's mesh the process on which it was a cell. `before`:
/// what this process had before. What fails on one process throws alike on all.
[[nodiscard]] std::vector<int> ranks_of_cells(const DistributedMesh& mesh, const History& before);

/// The history of a mesh whose roots are back: what this process had before, and what it has since.
/// Not collective.
[[nodiscard]] History joined(const History& before, const DistributedMesh& mesh);

}  // namespace octetra::distributed
