#pragma once

#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::properties {

/// The cells marked in `keep`, with their vertices, tagged facets and tagged edges, in the same
/// order.
[[nodiscard]] Mesh submesh(const Mesh& mesh, const std::vector<char>& keep);

}  // namespace octetra::properties
