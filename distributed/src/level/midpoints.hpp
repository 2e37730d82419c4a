#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Appends the midpoint of an edge to the mesh's vertices, and its ends and attributes to those
/// lists; not its marker.
void append_midpoint(DistributedMesh& mesh, VertexIndex low, VertexIndex high);

/// Learns that the edge of a midpoint is tagged, or in a tagged facet, with this marker: an edge
/// tells more than a facet, a facet more than nothing; among equals the smallest marker counts.
void take_marker(MidpointMarker& known, MidpointMarker::Source source, Marker marker);

}  // namespace octetra::distributed
