#pragma once

#include <memory>
#include <optional>

#include <octetra/dolfinx/convert.hpp>

#include "nodes.hpp"

namespace octetra::dolfinx {

/// Collective. Returns the mesh's tagged facets as tags of the DOLFINx mesh created from it, on all
/// ranks that have the facets, including facets of ghost cells. Numbers the facets of the DOLFINx
/// mesh.
[[nodiscard]] std::optional<MarkerTags> tag_facets(
    const distributed::AdaptiveMesh& mesh, const Nodes& nodes,
    const std::shared_ptr<const ::dolfinx::mesh::Mesh>& made);

}  // namespace octetra::dolfinx
