#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/full_sweep/edge_numbering.hpp"

namespace octetra::distributed {

/// Updates the interfaces for a level: halves of bisected edges, children of bisected faces, and
/// the edges between those children. The first half or child replaces its parent; the others are
/// appended to the list, first those of edges, then those of faces, in the order of their parents.
/// So both ranks obtain the same lists without communication, whichever implementation of a level
/// each uses. `points` may include vertices of the level, while `numbering` and `midpoints` (by
/// edge, none() for unmarked ones) refer to the mesh before it.
void bisect_interfaces(std::vector<Interface>& interfaces,
                       const IndexVector<VertexIndex, Point>& points,
                       const EdgeNumbering& numbering,
                       const IndexVector<EdgeIndex, VertexIndex>& midpoints);

}  // namespace octetra::distributed
