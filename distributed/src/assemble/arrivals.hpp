#pragma once

#include <cstddef>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "assemble/cut_bytes.hpp"
#include "assemble/has_lists.hpp"
#include "assemble/root_message.hpp"

namespace octetra::distributed {

/// The received roots: a part of the input without interfaces, whose communicator contains this
/// process alone.
struct Arrivals {
    DistributedMesh part;
    CutRoots cuts;                  ///< patterns of the roots in all steps
    std::vector<int> rank_of_root;  ///< the process that sent each root
};

/// Assembles the messages from each process, by rank. `attributes_per_point` is that of the mesh.
/// Not collective.
[[nodiscard]] Arrivals arrivals_of(const std::vector<RootMessage>& messages, const HasLists& has,
                                   std::size_t attributes_per_point);

}  // namespace octetra::distributed
