#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/migration.hpp>

#include "assemble/arrivals.hpp"
#include "assemble/departures.hpp"
#include "assemble/has_lists.hpp"

namespace octetra::distributed {

/// Staying and received entities as one part, in canonical order, without interfaces.
struct MergedPart {
    DistributedMesh mesh;
    std::vector<int> rank_of_root;     ///< the process that sent each root, or this one
    Migration::Message kept_vertices;  ///< old and new local indices
};

/// Merges a part with received roots. Both are in canonical order, and so is the result: vertices
/// are merged in ascending order, other entities root by root. Takes time proportional to the size
/// of both; nothing is bisected again. Not collective.
[[nodiscard]] MergedPart merge_parts(const DistributedMesh& before, const Departures& departures,
                                     const Arrivals& arrivals, const HasLists& has);

}  // namespace octetra::distributed
