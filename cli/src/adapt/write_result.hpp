#pragma once

#include <string>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/field.hpp>

namespace octetra::cli {

/// Collective. Writes the mesh, and its fields, as the extension says. Returns what the format
/// cannot hold, if anything, in a sentence.
[[nodiscard]] std::vector<std::string> write_result(const distributed::AdaptiveMesh& mesh,
                                                    const std::vector<distributed::Field>& fields,
                                                    const std::string& path);

}  // namespace octetra::cli
