#pragma once

#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "history/cut_roots.hpp"
#include "migrate/root_message.hpp"

namespace octetra::distributed {

/// What a process has of the input, and the process that each of it goes to, or stays with.
struct Departures {
    DistributedMesh input;
    CutRoots cuts;  ///< what the steps did to the roots
    std::vector<int> rank_of_root;
    std::vector<int>
        rank_of_facet;  ///< a facet or tagged edge goes with the first cell that has it
    std::vector<int> rank_of_edge;
};

/// Of a mesh in canonical order. Not collective.
[[nodiscard]] Departures departures_of(const DistributedMesh& mesh,
                                       std::span<const int> rank_of_root);

/// The bytes of a RootMessage to each process; none to this one, and to those that get nothing. Not
/// collective.
[[nodiscard]] std::vector<std::vector<std::byte>> packed_messages(const Departures& departures);

}  // namespace octetra::distributed
