#pragma once

#include "findings/findings.hpp"
#include "mesh/judged_mesh.hpp"
#include "refinement/descent.hpp"

namespace octetra::verify {

/// Collective. Measures the volume of each region and the area of each facet marker of a mesh by
/// itself.
void measure_sums(const JudgedMesh& judged, Findings& findings);

/// Collective. Regions have the volumes, and facets with a marker the area, that they have in the
/// coarse mesh: volumes exactly where no midpoint was rounded, else to within a bound that follows
/// from Descent::rounding; areas, whose roots are rounded, to within that of these, too. Also
/// measures both. Tags must be those that are inherited.
std::string check_sums(const JudgedMesh& coarse, const JudgedMesh& fine, const Descent& descent,
                       Findings& findings);

}  // namespace octetra::verify
