#pragma once

#include <string>
#include <string_view>

#include <octetra/core/maps.hpp>
#include <octetra/verify/verify.hpp>

#include "findings/findings.hpp"
#include "mesh/judged_mesh.hpp"
#include "refinement/descent.hpp"
#include "refinement/lines.hpp"

/// The checks of a refinement that need its descent. Each adds its violations to the findings.
namespace octetra::verify {

/// Fine faces have one cell only where they lie on the coarse boundary.
std::string check_cover(const JudgedMesh& coarse, const JudgedMesh& fine, const Descent& descent,
                        Findings& findings);

/// The exact volumes of the pieces of each coarse cell, and the exact vector areas of the pieces of
/// each face on the coarse boundary, sum up to its own; where midpoints were rounded, to within a
/// bound that follows from Descent::rounding.
std::string check_volumes(const JudgedMesh& coarse, const JudgedMesh& fine, const Descent& descent,
                          Findings& findings);

/// Region tags, markers and attributes are those that are inherited. If the fine mesh has no
/// attributes or vertex markers, and the options say why it cannot, these are not checked.
void check_tags(const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines,
                const Descent& descent, const VerifyOptions& options, Findings& findings);

/// A parent map says what is found here.
std::string check_maps(const RefinementMaps& maps, const JudgedMesh& coarse, const JudgedMesh& fine,
                       const Descent& descent, Findings& findings);

/// The fine mesh is what the request asks for.
std::string check_request(const Request& request, const JudgedMesh& coarse, const JudgedMesh& fine,
                          Lines& lines, const Descent& descent, Findings& findings);

}  // namespace octetra::verify
