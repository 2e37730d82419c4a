#pragma once

#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "history/has_lists.hpp"
#include "migrate/root_message.hpp"

namespace octetra::distributed {

/// The received roots with their descendants: a part without interfaces, in canonical order, whose
/// communicator contains this process alone.
struct Arrivals {
    DistributedMesh part;
    std::vector<int> rank_of_root;  ///< the process that sent each root
};

/// Assembles the messages from each process, by rank, and applies `step_count` steps to the roots.
/// `attributes_per_point` is that of the mesh. Not collective.
[[nodiscard]] Arrivals arrivals_of(const std::vector<RootMessage>& messages, const HasLists& has,
                                   std::size_t attributes_per_point, std::size_t step_count);

}  // namespace octetra::distributed
