#pragma once

#include <octetra/core/mesh.hpp>

namespace octetra {

/// The first listed facet that is a face of no cell; none() if there is no such facet.
/// Vertex numbers must be in range. Takes 8 bytes per vertex and 4 per facet meanwhile.
[[nodiscard]] FacetIndex find_stray_facet(const Mesh& mesh);

/// The first listed edge that is an edge of no cell, likewise.
[[nodiscard]] EdgeIndex find_stray_edge(const Mesh& mesh);

}  // namespace octetra
