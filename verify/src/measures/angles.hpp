#pragma once

#include "findings/findings.hpp"
#include "mesh/judged_mesh.hpp"
#include "refinement/descent.hpp"

namespace octetra::verify {

/// Measures the angles of all positive cells, in floating point.
[[nodiscard]] AngleFigures measure_angles(const JudgedMesh& judged);

/// The same by depth below the coarse cells.
[[nodiscard]] std::vector<DepthFigures> measure_by_depth(const JudgedMesh& fine,
                                                         const Descent& descent);

/// No dihedral angle is less than `degrees`, exactly.
std::string check_dihedral_angles(const JudgedMesh& judged, double degrees, Findings& findings);

/// Pieces of a coarse face keep half of its smallest angle: exactly where no midpoint was rounded
/// and no length that was compared; else to within what the rounding can turn an edge by.
std::string check_face_angles(const JudgedMesh& coarse, const JudgedMesh& fine,
                              const Descent& descent, Findings& findings);

}  // namespace octetra::verify
