#pragma once

#include <vector>

#include <octetra/core/expression.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Collective, within a transaction. Returns for each cell of this process the distance of its
/// centroid to the nearest of the tagged facets of the whole mesh that have the marker or are in
/// the group that the term names. No process gets the facets of others: a process sends a centroid
/// to those that may have a nearer facet than its own. Throws InputError if no facet has the
/// marker.
[[nodiscard]] std::vector<double> facet_distances(const DistributedMesh& mesh, const Term& term);

}  // namespace octetra::distributed
