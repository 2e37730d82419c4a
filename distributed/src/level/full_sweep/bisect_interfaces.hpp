#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/full_sweep/edge_numbering.hpp"

namespace octetra::distributed {

/// Brings the interfaces from one level to the next: halves of bisected edges, pieces of bisected
/// faces, and the edges between those pieces. The first half or piece takes the place of the whole;
/// the others follow at the end of the list, first those of edges, then those of faces, in the
/// order of the places. So both sides come to the same lists without a word, whichever way each
/// goes about the level. `points` may have more than those of the level before, in which
/// `numbering` and `midpoints` (by edge, none() where not bisected) number.
void bisect_interfaces(std::vector<Interface>& interfaces,
                       const IndexVector<VertexIndex, Point>& points,
                       const EdgeNumbering& numbering,
                       const IndexVector<EdgeIndex, VertexIndex>& midpoints);

}  // namespace octetra::distributed
