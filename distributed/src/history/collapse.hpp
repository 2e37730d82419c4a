#pragma once

#include <array>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "history/cuts.hpp"
#include "pattern/length_order.hpp"

namespace octetra::distributed {

/// A cell that a step cut.
struct CollapsedCell {
    CellIndex cell;  ///< its number before the step
    Cut cut = 0;
    LengthOrder order = 0;
    std::array<VertexIndex, 6> midpoints;  ///< of the edges that the step bisected
};

/// The cells before a step, and those of them that it cut.
struct CollapsedStep {
    IndexVector<CellIndex, CellVertices> cells;
    std::vector<CollapsedCell> cut;
};

/// Takes a step back: children become their parents. `cells` are those after it, in canonical
/// order; vertices from `first_midpoint` on are the step's own.
[[nodiscard]] CollapsedStep collapse(const IndexVector<CellIndex, CellVertices>& cells,
                                     const CutRuns& step, VertexIndex first_midpoint,
                                     const IndexVector<VertexIndex, Point>& points);

}  // namespace octetra::distributed
