#pragma once

#include <array>
#include <cstddef>

#include <octetra/core/mesh.hpp>

#include "edge_stars.hpp"

namespace octetra::distributed {

/// How a triangle of the mesh is bisected.
struct BisectedTriangle {
    std::size_t piece_count = 1;
    std::array<FacetVertices, 4> pieces{};  ///< in canonical order
    std::size_t inner_edge_count = 0;
    std::array<EdgeVertices, 3> inner_edges{};  ///< between the pieces, in order of bisection
};

/// `triangle` must be a face of a cell, and the selection closed.
[[nodiscard]] BisectedTriangle bisect_triangle(
    const FacetVertices& triangle, const IndexVector<VertexIndex, Point>& points,
    const EdgeStars& stars, const IndexVector<EdgeIndex, VertexIndex>& midpoints);

}  // namespace octetra::distributed
