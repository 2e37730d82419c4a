#pragma once

#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "history/cut_roots.hpp"
#include "migrate/root_message.hpp"

namespace octetra::distributed {

/// The part of the input that a process has, and the destination rank of each entity, which may be
/// this rank.
struct Departures {
    DistributedMesh input;
    CutRoots cuts;  ///< patterns of the roots in all steps
    std::vector<int> rank_of_root;
    std::vector<int>
        rank_of_facet;  ///< a facet or tagged edge moves with the first cell that has it
    std::vector<int> rank_of_edge;
};

/// Requires a mesh in canonical order. Not collective.
[[nodiscard]] Departures departures_of(const DistributedMesh& mesh,
                                       std::span<const int> rank_of_root);

/// Returns a packed RootMessage to each process; empty for this one, and for those that receive no
/// root. Not collective.
[[nodiscard]] std::vector<std::vector<std::byte>> packed_messages(const Departures& departures);

}  // namespace octetra::distributed
