#pragma once

#include <optional>
#include <string>

#include <octetra/core/maps.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/verify/verify.hpp>

#include "commands/verify/coarsened.hpp"

/// --verify, for commands whose result is an AdaptiveMesh. If the result is not valid, the
/// functions print the reason to stdout.
namespace octetra::cli {

/// The current mesh in the form that the verifier takes.
struct JudgedMesh {
    std::string name;  ///< for messages
    std::uint32_t index_base = 0;
    verify::MeshSlice slice;
};

/// Collective. Returns the current mesh for the verifier.
[[nodiscard]] JudgedMesh mesh_to_judge(const distributed::AdaptiveMesh& mesh, std::string name);

/// The property to be verified.
struct Judgement {
    std::optional<verify::Request> request;  ///< if not set: any refinement by midpoints
    const RefinementMaps* maps = nullptr;    ///< checked if not null
    std::string fine;                        ///< its name, for messages
    bool is_coarse_checked = false;          ///< whether --check has verified the coarse mesh
};

/// Collective. Verifies a distributed mesh as a refinement of another, as octetra verify does; no
/// process holds the whole mesh.
[[nodiscard]] bool is_valid_refinement(const distributed::AdaptiveMesh& fine, JudgedMesh coarse,
                                       const Judgement& judgement);

/// Collective. Verifies the result of coarsening a checkpoint, as octetra verify --coarsened-from
/// does: the first process works, and holds the whole mesh.
[[nodiscard]] bool is_valid_coarsening(const distributed::AdaptiveMesh& after,
                                       const Coarsened& asked, const std::string& name);

}  // namespace octetra::cli
