#pragma once

#include <octetra/core/mesh.hpp>
#include <octetra/verify/verify.hpp>

#include "findings/findings.hpp"

namespace octetra::verify {

/// Runs the checks of verify_refinement() on whole meshes. Returns false if numbers are out of
/// range or the coarse mesh is invalid, so that no further checks are possible.
bool judge_refinement(const Mesh& coarse, const Mesh& fine, const VerifyOptions& options,
                      Findings& findings);

}  // namespace octetra::verify
