#pragma once

#include "findings/findings.hpp"
#include "mesh/judged_mesh.hpp"
#include "refinement/descent.hpp"

namespace octetra::verify {

/// Collective. Computes the volume of each region and the area of each facet marker of a mesh.
void measure_sums(const JudgedMesh& judged, Findings& findings);

/// Collective. Checks that regions have the same volume, and markers of facets the same area, as in
/// the coarse mesh: volumes exactly if no midpoint was rounded, otherwise up to a bound that
/// follows from Descent::rounding; areas also up to the rounding of square roots. Stores the
/// figures of both. Precondition: tags are the inherited ones.
std::string check_sums(const JudgedMesh& coarse, const JudgedMesh& fine, const Descent& descent,
                       Findings& findings);

}  // namespace octetra::verify
