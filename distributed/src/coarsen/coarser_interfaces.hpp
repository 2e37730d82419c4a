#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "coarsen/kept_vertices.hpp"
#include "history/vertex_levels.hpp"

namespace octetra::distributed {

/// Returns the interfaces without the removed vertices, in terms of the previous vertex numbers.
/// The order remains the same on both ranks: a coarse entity takes the position of the first entity
/// that is merged into it.
[[nodiscard]] std::vector<Interface> coarser_interfaces(const std::vector<Interface>& interfaces,
                                                        const VertexLevels& levels,
                                                        const KeptVertices& kept);

}  // namespace octetra::distributed
