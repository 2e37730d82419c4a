#pragma once

#include <span>
#include <string>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/field.hpp>

namespace octetra::cli {

/// Collective. Writes the mesh and its fields in the format of the extension. Returns a sentence
/// naming the data that the format cannot hold, or an empty string.
[[nodiscard]] std::string write_result(const distributed::AdaptiveMesh& mesh,
                                       std::span<const distributed::Field> fields,
                                       const std::string& path);

}  // namespace octetra::cli
