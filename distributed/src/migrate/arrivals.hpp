#pragma once

#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "migrate/has_lists.hpp"
#include "migrate/root_message.hpp"

namespace octetra::distributed {

/// The roots that have come, with all that the steps made of them: a part without interfaces, of
/// a group of this process alone, in canonical order.
struct Arrivals {
    DistributedMesh part;
    std::vector<int> rank_of_root;  ///< the process that each root comes from
};

/// Of the messages from each process, by rank, of so many steps; attributes_per_point of vertices.
/// Not collective.
[[nodiscard]] Arrivals arrivals_of(const std::vector<RootMessage>& messages, const HasLists& has,
                                   std::size_t attributes_per_point, std::size_t step_count);

}  // namespace octetra::distributed
