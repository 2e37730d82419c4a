#pragma once

#include <vector>

#include "findings/findings.hpp"
#include "mesh/judged_mesh.hpp"

namespace octetra::verify {

/// The faces of one cell, with their vertices and edges. In a part of a mesh, also faces whose
/// other cell the process does not hold.
struct Boundary {
    std::vector<CellFace> cell_faces;
    std::vector<FacetVertices> faces;  ///< the same, oriented outwards
    std::vector<EdgeVertices> edges;   ///< of these faces, ascending
    /// For each edge, the number of boundary faces at it.
    std::vector<std::uint32_t> faces_at_edge;
    /// The numbers in `edges` of the edges of each face, in the order of triangle_edges.
    std::vector<std::array<std::uint32_t, 3>> edges_of_face;
};

[[nodiscard]] Boundary boundary_of(const JudgedMesh& judged);

/// Collective. Returns true only if no two cells meet except in common vertices, edges and faces,
/// so that no vertex hangs and no parts of the boundary cross. Inspects the boundary and its cells
/// only (docs/verify-proof.md). Returns false if there is a violation, or if it cannot decide.
/// Precondition: the checks well-formed, orientation and faces have passed on all processes.
[[nodiscard]] bool boundary_proves_conformity(const JudgedMesh& judged, Findings& findings);

}  // namespace octetra::verify
