#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <octetra/verify/mesh_slice.hpp>

#include "findings/findings.hpp"
#include "mesh/judged_mesh.hpp"

/// Checks of a single mesh. Each adds its violations to the findings and returns its note. They
/// inspect everything that a process sees of the mesh, and report violations in its domain.
namespace octetra::verify {

/// Collective. As check_ranges(), for a slice.
std::string check_slice_ranges(const MeshSlice& slice, Which which, Findings& findings);

/// Checks that vertex numbers are less than `vertex_count`, that lists have the right length, and
/// that coordinates are finite. Further checks require this one to pass. Reports everything in
/// `mesh`, which may be a slice.
std::string check_ranges(const Mesh& mesh, std::uint64_t vertex_count, Which which,
                         Findings& findings);

/// Checks for repeated vertices and cells, and tagged facets and edges of no cell. Sets all members
/// of `judged` except `sign`.
std::string check_well_formed(JudgedMesh& judged, Findings& findings);

/// Checks that no facet or edge is listed twice with different markers.
std::string check_tagged_markers(const JudgedMesh& judged, Findings& findings);

/// Whether a vertex of no cell is a violation, or only counted in the note.
enum class Unused : std::uint8_t { noted, violation };

/// Checks for unused and coincident vertices, except those for which `tolerated` is nonzero. Counts
/// the unused ones that are not violations.
std::string check_vertices(const JudgedMesh& judged, const std::vector<char>& tolerated,
                           Unused unused, Findings& findings);

/// Checks exactly that every cell is positive. Sets `sign`.
std::string check_orientation(JudgedMesh& judged, Findings& findings);

/// Checks that every face has one or two cells, on different sides of it. Counts faces and edges.
std::string check_faces(const JudgedMesh& judged, Findings& findings);

/// Checks exactly that no vertex lies on or in a cell of which it is not a corner.
std::string check_hanging(const JudgedMesh& judged, Findings& findings);

/// Checks that no edge meets a face of the boundary, and no edge of the boundary a face, except in
/// a common vertex or as a side of it. Preconditions: every cell is positive, and check_hanging has
/// passed.
std::string check_boundary_crossings(const JudgedMesh& judged, Findings& findings);

/// Returns the faces of one cell.
[[nodiscard]] std::vector<CellFace> boundary_faces(const JudgedMesh& judged);

/// Counts edges and vertices at which the mesh is not a manifold with boundary.
void count_singular(const JudgedMesh& judged, Facts& facts);

}  // namespace octetra::verify
