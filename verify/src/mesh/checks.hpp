#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <octetra/verify/mesh_slice.hpp>

#include "findings/findings.hpp"
#include "mesh/judged_mesh.hpp"

/// The checks of a mesh by itself. Each adds its violations to the findings and returns its note.
/// They look at all that a process sees of the mesh, and report what lies in its domain.
namespace octetra::verify {

/// Collective. check_ranges() of a slice.
std::string check_slice_ranges(const MeshSlice& slice, Which which, Findings& findings);

/// Numbers less than `vertex_count`, lists as long as they must be, coordinates finite. Nothing
/// else may look at a mesh that fails this. Of slices, too: reports all that it is given.
std::string check_ranges(const Mesh& mesh, std::uint64_t vertex_count, Which which,
                         Findings& findings);

/// Repeated vertices and cells; tagged facets and edges of no cell. Fills all but `sign`.
std::string check_well_formed(JudgedMesh& judged, Findings& findings);

/// No facet or edge listed twice with different markers.
std::string check_tagged_markers(const JudgedMesh& judged, Findings& findings);

/// Whether a vertex that no cell has is a violation, or counted and mentioned in the note.
enum class Unused : std::uint8_t { noted, violation };

/// Unused and coincident vertices, except those of which tolerated(v) holds. Counts the unused ones
/// that are no violation.
std::string check_vertices(const JudgedMesh& judged, const std::vector<char>& tolerated,
                           Unused unused, Findings& findings);

/// Every cell positive, exactly. Fills `sign`.
std::string check_orientation(JudgedMesh& judged, Findings& findings);

/// Every face in one or two cells, that lie on different sides of it. Counts faces and edges.
std::string check_faces(const JudgedMesh& judged, Findings& findings);

/// No vertex on or in a cell that does not have it, exactly.
std::string check_hanging(const JudgedMesh& judged, Findings& findings);

/// No edge meets a face of the boundary, and no edge of the boundary a face, but in a vertex of
/// both or as a side. Every cell must be positive, and check_hanging must have passed.
std::string check_boundary_crossings(const JudgedMesh& judged, Findings& findings);

/// Faces of one cell, by their tags.
[[nodiscard]] std::vector<CellFace> boundary_faces(const JudgedMesh& judged);

/// Counts edges and vertices where the mesh is no manifold with boundary.
void count_singular(const JudgedMesh& judged, Facts& facts);

}  // namespace octetra::verify
