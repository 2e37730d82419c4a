#pragma once

#include <optional>
#include <string>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/verify/verify.hpp>

namespace octetra::cli {

/// What a mesh is judged as, and its name and that of the mesh it is to refine, for people.
struct Judgement {
    std::optional<verify::Request> request;  ///< or any refinement by midpoints
    std::string fine;
    std::string coarse;
};

/// Collective. Judges a mesh in several memories as a refinement of another, as octetra verify
/// does; no process has all of it. If it is not valid, says why on stdout.
[[nodiscard]] bool is_valid_result(const distributed::AdaptiveMesh& fine, verify::MeshSlice coarse,
                                   const Judgement& judgement);

}  // namespace octetra::cli
