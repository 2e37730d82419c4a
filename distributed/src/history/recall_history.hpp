#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "history/history.hpp"

/// How a mesh whose cells became roots gets back what it was before: roots go to where they were
/// cells then, where that part of the history is that they come from, and there they are
/// descendants again. Tagged facets and edges do the same: they went with any cell that has them.
namespace octetra::distributed {

/// Collective. Of each of these roots the process on which it was an entity. `before`: those that
/// this process had, as descendants of the roots before. What fails on one process throws alike on
/// all.
[[nodiscard]] std::vector<int> ranks_of_roots(const Communicator& processes,
                                              const AncestorMap& before,
                                              const std::vector<std::uint64_t>& roots);

/// The history of a mesh whose roots are back: what this process had before, and what it has since.
/// Not collective.
[[nodiscard]] History joined(const History& before, const DistributedMesh& mesh);

}  // namespace octetra::distributed
