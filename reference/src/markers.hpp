#pragma once

#include "edges.hpp"

namespace octetra::reference {

/// The marker that the midpoint of each edge of the table gets: the edge's own, where the
/// edge is tagged; else the smallest among the tagged facets that have the edge; else 0.
[[nodiscard]] IndexVector<EdgeIndex, Marker> midpoint_markers(const Mesh& mesh,
                                                              const EdgeTable& table);

}  // namespace octetra::reference
