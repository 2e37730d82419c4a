#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/migration.hpp>

#include "migrate/arrivals.hpp"
#include "migrate/departures.hpp"
#include "migrate/has_lists.hpp"

namespace octetra::distributed {

/// What stays and what has come as one part, in canonical order; without interfaces.
struct MergedPart {
    DistributedMesh mesh;
    std::vector<int> rank_of_root;     ///< the process that each root comes from, or this one
    Migration::Message kept_vertices;  ///< the numbers that they had, and that they have
};

/// Both are in canonical order, and so is the result: vertices are merged as they ascend, all else
/// root by root. Takes time in proportion to both, and none to bisect anything. Not collective.
[[nodiscard]] MergedPart merge_parts(const DistributedMesh& before, const Departures& departures,
                                     const Arrivals& arrivals, const HasLists& has);

}  // namespace octetra::distributed
