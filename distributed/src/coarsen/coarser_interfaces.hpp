#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "coarsen/kept_vertices.hpp"
#include "history/vertex_levels.hpp"

namespace octetra::distributed {

/// The interfaces without the vertices that go, which have the numbers still that they had. What
/// both sides have listed in the same order they have so afterwards: what is whole again stands
/// where the first of its pieces stood.
[[nodiscard]] std::vector<Interface> coarser_interfaces(const std::vector<Interface>& interfaces,
                                                        const VertexLevels& levels,
                                                        const KeptVertices& kept);

}  // namespace octetra::distributed
