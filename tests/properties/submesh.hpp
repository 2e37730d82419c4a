#pragma once

#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::properties {

/// The cells that are marked in `keep`, with the vertices, tagged facets and edges that they have.
/// All keep their order.
[[nodiscard]] Mesh submesh(const Mesh& mesh, const std::vector<char>& keep);

}  // namespace octetra::properties
