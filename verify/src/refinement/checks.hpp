#pragma once

#include <string>
#include <string_view>

#include <octetra/core/maps.hpp>
#include <octetra/verify/verify.hpp>

#include "findings/findings.hpp"
#include "mesh/judged_mesh.hpp"
#include "refinement/descent.hpp"
#include "refinement/lines.hpp"

/// Checks of a refinement that need its descent. Each adds its violations to the findings.
namespace octetra::verify {

/// Checks that fine faces have a single cell only on the coarse boundary.
std::string check_cover(const JudgedMesh& coarse, const JudgedMesh& fine, const Descent& descent,
                        Findings& findings);

/// Checks that the exact volumes of the pieces of each coarse cell, and the exact vector areas of
/// the pieces of each face on the coarse boundary, sum up to those of the whole; if midpoints were
/// rounded, up to a bound that follows from Descent::rounding.
std::string check_volumes(const JudgedMesh& coarse, const JudgedMesh& fine, const Descent& descent,
                          Findings& findings);

/// Checks that region tags, markers and attributes are the inherited ones. Missing attributes or
/// vertex markers of the fine mesh are not checked if the options give a reason for their absence.
void check_tags(const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines,
                const Descent& descent, const VerifyOptions& options, Findings& findings);

/// Checks that the refinement maps agree with the descent.
std::string check_maps(const RefinementMaps& maps, const JudgedMesh& coarse, const JudgedMesh& fine,
                       const Descent& descent, Findings& findings);

/// Checks that the fine mesh is the result of regular refinement of some cells: every coarse cell
/// consists of regular cells and of whole children of regular cells with one to five bisected
/// edges, and the longest edge of each face of a regular cell with a bisected edge is bisected.
std::string check_regular_closure(const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines,
                                  const Descent& descent, Findings& findings);

/// Checks that the dihedral angles, eta and solid angles of each fine cell are within the bounds
/// that are certified for regular refinement of its coarse cell: exactly, except for solid angles,
/// or up to the rounding of midpoints.
std::string check_certified_shapes(const JudgedMesh& coarse, const JudgedMesh& fine,
                                   const Descent& descent, Findings& findings);

}  // namespace octetra::verify
