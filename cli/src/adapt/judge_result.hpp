#pragma once

#include <optional>
#include <string>

#include <octetra/core/maps.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/verify/verify.hpp>

#include "commands/verify/coarsened.hpp"

/// --verify of commands whose result is an AdaptiveMesh. Where the result is not valid, functions
/// say why on stdout.
namespace octetra::cli {

/// The mesh as it is, as the verifier takes it.
struct JudgedMesh {
    std::string name;  ///< for people
    std::uint32_t index_base = 0;
    verify::MeshSlice slice;
};

/// Collective.
[[nodiscard]] JudgedMesh mesh_to_judge(const distributed::AdaptiveMesh& mesh, std::string name);

/// What a mesh is judged as.
struct Judgement {
    std::optional<verify::Request> request;  ///< or any refinement by midpoints
    const RefinementMaps* maps = nullptr;    ///< checked if given
    std::string fine;                        ///< its name, for people
    bool is_coarse_checked = false;          ///< has --check judged the coarse mesh?
};

/// Collective. Judges a mesh in several memories as a refinement of another, as octetra verify
/// does; no process has all of it.
[[nodiscard]] bool is_valid_refinement(const distributed::AdaptiveMesh& fine, JudgedMesh coarse,
                                       const Judgement& judgement);

/// Collective. Judges what coarsening has left of a checkpoint, as octetra verify --coarsened-from
/// does: the first process works, and has all of it.
[[nodiscard]] bool is_valid_coarsening(const distributed::AdaptiveMesh& after,
                                       const Coarsened& asked, const std::string& name);

}  // namespace octetra::cli
