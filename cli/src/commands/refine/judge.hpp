#pragma once

#include <octetra/core/maps.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/distributed/canonical_mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/verify/mesh_slice.hpp>

#include "commands/refine/options.hpp"

/// Verification of the result of octetra refine (--verify).
namespace octetra::cli {

/// Verifies the result of an engine. Prints the reason if it is not valid.
[[nodiscard]] bool is_valid(const Mesh& coarse, const Mesh& fine, const RefinementMaps& maps,
                            const Plan& plan, const RefineOptions& options);

/// Collective. As above, for a distributed mesh; no process holds the whole mesh.
[[nodiscard]] bool is_valid_distributed(verify::MeshSlice coarse, distributed::CanonicalMesh& fine,
                                        const Plan& plan, const RefineOptions& options,
                                        const distributed::Communicator& world);

}  // namespace octetra::cli
