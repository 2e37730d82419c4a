#pragma once

#include <string>

#include <octetra/distributed/adaptive_mesh.hpp>

namespace octetra::cli {

/// Collective. Writes the mesh as the extension says. Returns what the format cannot hold, in a
/// sentence, or nothing.
[[nodiscard]] std::string write_result(const distributed::AdaptiveMesh& mesh,
                                       const std::string& path);

}  // namespace octetra::cli
