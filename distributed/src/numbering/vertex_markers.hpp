#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// Collective. Returns the marker of each vertex of this process, equal on all processes that have
/// the vertex; empty if the input has no vertex markers. The marker of a midpoint follows from the
/// tagged edges and facets around its edge, of which each process may have different ones. A
/// failure of one process is thrown on all.
[[nodiscard]] std::vector<Marker> vertex_markers(const DistributedMesh& mesh,
                                                 const CanonicalNumbers& numbers);

}  // namespace octetra::distributed
