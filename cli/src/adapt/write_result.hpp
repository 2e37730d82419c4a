#pragma once

#include <string>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/field.hpp>

namespace octetra::cli {

/// Collective. Writes the mesh and its fields in the format of the extension. Returns sentences
/// naming the data that the format cannot hold, if any.
[[nodiscard]] std::vector<std::string> write_result(const distributed::AdaptiveMesh& mesh,
                                                    const std::vector<distributed::Field>& fields,
                                                    const std::string& path);

}  // namespace octetra::cli
