#pragma once

#include "findings/findings.hpp"
#include "mesh/judged_mesh.hpp"
#include "refinement/descent.hpp"

namespace octetra::verify {

/// Computes the angle figures of all positive cells, in floating point.
[[nodiscard]] AngleFigures measure_angles(const JudgedMesh& judged);

/// As above, by depth below the coarse cells.
[[nodiscard]] std::vector<DepthFigures> measure_by_depth(const JudgedMesh& fine,
                                                         const Descent& descent);

/// Checks exactly that no dihedral angle is less than `degrees`.
std::string check_dihedral_angles(const JudgedMesh& judged, double degrees, Findings& findings);

/// Checks that pieces of a coarse face have at least half of its smallest angle: exactly if neither
/// midpoints nor compared lengths were rounded, otherwise up to the angle by which rounding can
/// turn an edge.
std::string check_face_angles(const JudgedMesh& coarse, const JudgedMesh& fine,
                              const Descent& descent, Findings& findings);

}  // namespace octetra::verify
