#include "coarsen/family_division.hpp"

#include <algorithm>

#include "level/level.hpp"
#include "level/rounding_margin.hpp"
#include "pattern/length_order.hpp"
#include "pattern/triangle.hpp"

namespace octetra::distributed {

Pieces<4> FamilyDivision::operator()(std::uint32_t level, std::size_t root,
                                     const CellVertices& cell, const KeptMidpoints<4>& midpoints) {
    std::array<VertexIndex, 10> vertices;  // corners, then midpoints of edges
    std::ranges::copy(cell, vertices.begin());
    std::ranges::copy(midpoints, vertices.begin() + 4);
    unsigned edges = 0;
    for (std::size_t e = 0; e < 6; ++e) edges |= midpoints[e].is_none() ? 0U : 1U << e;
    const Pattern& pattern = PatternTable::get().pattern(length_order(mesh_->points, cell),
                                                         static_cast<EdgeMask>(edges));
    Pieces<4> pieces{.count = pattern.child_count, .vertices = {}};
    for (std::size_t k = 0; k < pieces.count; ++k) {
        pieces.vertices[k] = child_of(vertices, pattern.children[k]);
    }
    check(level, root, cell, pieces);
    return pieces;
}

Pieces<3> FamilyDivision::operator()(std::uint32_t, std::size_t, const FacetVertices& facet,
                                     const KeptMidpoints<3>& midpoints) const {
    const BisectedTriangle bisected = bisect_triangle(facet, midpoints, mesh_->points);
    Pieces<3> pieces{.count = bisected.piece_count, .vertices = {}};
    std::ranges::copy(bisected.pieces, pieces.vertices.begin());
    return pieces;
}

Pieces<2> FamilyDivision::operator()(std::uint32_t, std::size_t, const EdgeVertices& edge,
                                     const KeptMidpoints<2>& midpoint) const {
    return {.count = 2, .vertices = {{{edge[0], midpoint[0]}, {midpoint[0], edge[1]}}}};
}

void FamilyDivision::check(std::uint32_t level, std::size_t root, const CellVertices& cell,
                           const Pieces<4>& pieces) {
    if (last_root_[level - 1] == root || has_rounding_margin(mesh_->points, cell)) return;
    for (std::size_t k = 0; k < pieces.count; ++k) {
        const int sign = sign_of(pieces.vertices[k], mesh_->points);
        if (sign > 0) continue;
        failures_[level - 1].note(mesh_->cell_ancestors.roots[root], sign);
        last_root_[level - 1] = root;
        return;
    }
}

}  // namespace octetra::distributed
