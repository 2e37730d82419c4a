#pragma once

#include <memory>
#include <optional>

#include <octetra/dolfinx/hand_over.hpp>

#include "nodes.hpp"

namespace octetra::dolfinx {

/// Collective. The mesh's tagged facets as facets of the DOLFINx mesh that was made of it, on all
/// ranks that have them, also as those of ghost cells. Numbers the DOLFINx mesh's facets.
[[nodiscard]] std::optional<MarkerTags> tag_facets(
    const distributed::AdaptiveMesh& mesh, const Nodes& nodes,
    const std::shared_ptr<const ::dolfinx::mesh::Mesh>& made);

}  // namespace octetra::dolfinx
