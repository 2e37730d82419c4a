#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "level/transition_cells.hpp"
#include "pattern/patterns.hpp"
#include "regular/descent.hpp"

namespace octetra::distributed {

/// A cell of which some edges are bisected.
struct DividedCell {
    std::array<VertexIndex, 10> vertices;  ///< corners, then midpoints of edges or none()
    EdgeMask edges = 0;                    ///< the bisected ones

    /// `pieces` are all descendants of the cell, which has this generation.
    DividedCell(const DistributedMesh& mesh, const TransitionCells& cells,
                TransitionCells::Family pieces, std::uint32_t generation);

    [[nodiscard]] CellVertices corners() const {
        return {vertices[0], vertices[1], vertices[2], vertices[3]};
    }
};

/// The cells before a level.
struct BisectedCells {
    std::span<const std::uint32_t> first;  ///< the first child of each; then the number of children
    std::span<const EdgeMask> marked;      ///< the bisected edges of each
    std::uint32_t generation = 0;          ///< of these edges
};

/// Returns the kinds of the cells after a level. If more edges of the parent of transition cells
/// have been bisected, its descendants are the pieces into which all its bisected edges divide it,
/// but in another order; they are put into canonical order, in `mesh` and in `cells`. `before` has
/// the kinds before the level and all generations.
[[nodiscard]] TransitionCells::Kinds order_families(DistributedMesh& mesh, Descent& cells,
                                                    const TransitionCells& before,
                                                    const BisectedCells& level);

}  // namespace octetra::distributed
