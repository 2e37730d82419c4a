#pragma once

#include "findings/findings.hpp"
#include "mesh/judged_mesh.hpp"
#include "refinement/descent.hpp"

namespace octetra::verify {

/// Collective. Returns the angle figures of all positive cells of all processes, in floating point.
/// The cell of the smallest angle is none() on processes that do not own it.
[[nodiscard]] AngleFigures measure_angles(const JudgedMesh& judged, const ProcessGroup& group);

struct AnglesByDepth {
    AngleFigures all;
    std::vector<DepthFigures> by_depth;  ///< by depth below the coarse cells
};

/// Collective. As above, and by depth, where numbers of cells are of this process.
[[nodiscard]] AnglesByDepth measure_by_depth(const JudgedMesh& fine, const Descent& descent,
                                             const ProcessGroup& group);

/// Checks exactly that no dihedral angle is less than `degrees`.
std::string check_dihedral_angles(const JudgedMesh& judged, double degrees, Findings& findings);

/// Checks that pieces of a coarse face have at least half of its smallest angle: exactly if neither
/// midpoints nor compared lengths were rounded, otherwise up to the angle by which rounding can
/// turn an edge.
std::string check_face_angles(const JudgedMesh& coarse, const JudgedMesh& fine,
                              const Descent& descent, Findings& findings);

}  // namespace octetra::verify
