#pragma once

#include <octetra/core/mesh.hpp>
#include <octetra/verify/verify.hpp>

#include "findings/findings.hpp"

namespace octetra::verify {

/// The checks of verify_refinement(), of whole meshes. False if numbers are out of range, or the
/// coarse mesh is not as it must be: then nothing else can be said.
bool judge_refinement(const Mesh& coarse, const Mesh& fine, const VerifyOptions& options,
                      Findings& findings);

}  // namespace octetra::verify
