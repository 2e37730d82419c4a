#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "history/history.hpp"

/// Restores the history of a mesh whose cells became roots: the roots return to the processes on
/// which they were cells, because their history is there, and become descendants again. Tagged
/// facets and edges return likewise, since they may have migrated with any cell that has them.
namespace octetra::distributed {

/// Collective. Returns for each of the `roots` the process that had it as an entity. `before` are
/// the ancestors of this process's entities at that time. A failure of one process is thrown on
/// all.
[[nodiscard]] std::vector<int> ranks_of_roots(const Communicator& processes,
                                              const AncestorMap& before,
                                              const std::vector<std::uint64_t>& roots);

/// Returns the history of a mesh whose roots have returned: the levels of `before` followed by
/// those of `mesh`. Not collective.
[[nodiscard]] History joined(const History& before, const DistributedMesh& mesh);

}  // namespace octetra::distributed
