#pragma once

#include <optional>

#include <octetra/core/closure.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/verify/verify.hpp>

#include "adapt/run.hpp"
#include "commands/verify/coarsened.hpp"

/// --verify, for commands that refine or coarsen a mesh. If the result is not valid, the functions
/// print the reason to stdout.
namespace octetra::cli {

/// Collective. Returns the slices of a mesh.
[[nodiscard]] verify::MeshSlice slice_of(const distributed::AdaptiveMesh& mesh);
[[nodiscard]] verify::MeshSlice slice_of(const distributed::DistributedMesh& mesh);

/// The property to be verified.
struct Judgement {
    std::optional<verify::Request> request;  ///< if not set: any refinement by midpoints
    Closure closure = Closure::longest_edge;
    MeshSource* maps = nullptr;   ///< has maps to be checked, if not null
    bool is_only_output = false;  ///< whether the run writes no other mesh
};

/// Prints a note if the verifier cannot evaluate the selection, so that --verify checks a
/// refinement of any cells.
void note_unverified(const Run& run, const Selection& selection);

/// Collective. Verifies OUT as a refinement of MESH, as octetra verify does; no process holds the
/// whole mesh.
[[nodiscard]] bool is_valid_refinement(const Run& run, verify::MeshSlice coarse,
                                       verify::MeshSlice fine, const Judgement& judgement);

/// Collective. Verifies the result of coarsening a checkpoint, as octetra verify --coarsened-from
/// does: the first process works, and holds the whole mesh.
[[nodiscard]] bool is_valid_coarsening(const Run& run, const distributed::AdaptiveMesh& after,
                                       const Coarsened& asked);

}  // namespace octetra::cli
