#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/entity_transfer.hpp>

namespace octetra::distributed {

/// The bisection of a triangle of the mesh.
struct BisectedTriangle {
    std::size_t piece_count = 1;
    std::array<FacetVertices, 4> pieces{};   ///< in canonical order
    std::array<std::uint8_t, 4> halvings{};  ///< number of bisections that made each piece
    std::size_t inner_edge_count = 0;
    std::array<EdgeVertices, 3> inner_edges{};  ///< between the pieces, in order of bisection
};

/// The possible divisions of a triangle and of an edge; number 0: not bisected.
inline constexpr std::array<Division, 5> triangle_divisions{
    {{1, {0}}, {2, {1, 1}}, {3, {1, 2, 2}}, {3, {2, 2, 1}}, {4, {2, 2, 2, 2}}}};
inline constexpr std::array<Division, 2> edge_divisions{{{1, {0}}, {2, {1, 1}}}};

/// Returns the number of the division in triangle_divisions.
[[nodiscard]] inline std::uint8_t division_of(const BisectedTriangle& bisected) {
    switch (bisected.piece_count) {
        case 1: return 0;
        case 2: return 1;
        case 3: return bisected.halvings[0] == 1 ? 2 : 3;
        default: return 4;
    }
}

/// Bisects a triangle. `midpoints` are those of its edges, in the order of triangle_edges; none()
/// for edges that are not bisected.
[[nodiscard]] BisectedTriangle bisect_triangle(const FacetVertices& triangle,
                                               const std::array<VertexIndex, 3>& midpoints,
                                               const IndexVector<VertexIndex, Point>& points);

}  // namespace octetra::distributed
