#pragma once

#include <octetra/core/maps.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/distributed/canonical_mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/verify/mesh_slice.hpp>

#include "commands/refine/options.hpp"

/// octetra refine --verify.
namespace octetra::cli {

/// Judges what an engine has made. If it is not valid, says why.
[[nodiscard]] bool is_valid(const Mesh& coarse, const Mesh& fine, const RefinementMaps& maps,
                            const Plan& plan, const RefineOptions& options);

/// Collective. The same of a mesh in several memories; no process has all of it.
[[nodiscard]] bool is_valid_together(verify::MeshSlice coarse, distributed::CanonicalMesh& fine,
                                     const Plan& plan, const RefineOptions& options,
                                     const distributed::Communicator& world);

}  // namespace octetra::cli
