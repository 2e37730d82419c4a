#pragma once

#include <array>
#include <cstddef>

#include <octetra/core/mesh.hpp>

namespace octetra::distributed {

/// How a triangle of the mesh is bisected.
struct BisectedTriangle {
    std::size_t piece_count = 1;
    std::array<FacetVertices, 4> pieces{};  ///< in canonical order
    std::size_t inner_edge_count = 0;
    std::array<EdgeVertices, 3> inner_edges{};  ///< between the pieces, in order of bisection
};

/// `midpoints` of the triangle's edges, in the order of triangle_edges; none() where an edge is not
/// bisected. The selection must be closed.
[[nodiscard]] BisectedTriangle bisect_triangle(const FacetVertices& triangle,
                                               const std::array<VertexIndex, 3>& midpoints,
                                               const IndexVector<VertexIndex, Point>& points);

}  // namespace octetra::distributed
