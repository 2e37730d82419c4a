#pragma once

#include <functional>
#include <vector>

#include "findings/findings.hpp"
#include "hubs/hubs.hpp"
#include "mesh/judged_mesh.hpp"

/// Searches for vertices on cells and for edges that meet faces, decided exactly. They take n log n
/// at hubs, too.
namespace octetra::verify {

/// Called for a vertex on or in a cell that does not have it, with the number of faces of the cell
/// that contain it.
using FoundHanging = std::function<void(VertexIndex, CellIndex, int)>;

/// Finds the vertices that lie on or in cells without being their corners. Precondition: the cells
/// are positive.
void search_hanging(const JudgedMesh& judged, const Hubs& hubs,
                    const std::vector<VertexIndex>& vertices, const std::vector<CellIndex>& cells,
                    Findings& findings, const FoundHanging& found);

/// Called for an edge and a face that have a point, but no vertex, in common.
using FoundCrossing = std::function<void(const EdgeVertices&, const FacetVertices&)>;

/// Finds the edges that meet faces without a common vertex. Each pair is tested by the process in
/// whose domain it lies.
void search_crossings(const JudgedMesh& judged, const Hubs& hubs,
                      const std::vector<EdgeVertices>& edges,
                      const std::vector<FacetVertices>& faces, Findings& findings,
                      const FoundCrossing& found);

}  // namespace octetra::verify
