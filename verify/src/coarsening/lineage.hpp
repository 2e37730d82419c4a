#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/verify/verify_coarsening.hpp>

#include "lookup/edge_table.hpp"

namespace octetra::verify {

/// One element for each vertex of a lineage.
using VertexSet = IndexVector<VertexIndex, char>;

/// A cell that a step has cut, and the cut cell from which it was created.
struct CutCell {
    CellVertices vertices;
    int step = 0;
    std::uint32_t parent = 0;  ///< index in Generations::cut; no_parent for a cell of the input
};
inline constexpr std::uint32_t no_parent = std::numeric_limits<std::uint32_t>::max();

struct PresentCell {
    CellVertices vertices;
    CellIndex root;  ///< the cell of the input
    std::uint32_t parent = no_parent;
};

/// The cells of a mesh in file order, and all cells that were cut to create them.
struct Generations {
    std::vector<CutCell> cut;
    std::vector<PresentCell> present;
};

/// All vertices of an input and of the steps applied to it, with the numbers that they have in the
/// mesh after the last step: first those of the input, then for each step the midpoints, in the
/// order of the (smaller, larger) ends of their edges.
struct Lineage {
    IndexVector<VertexIndex, Point> points;
    IndexVector<VertexIndex, int> step;  ///< its step, from 1; 0 for a vertex of the input
    IndexVector<VertexIndex, EdgeVertices> halves;  ///< ends of its edge; none() for the input
    EdgeTable midpoints{0};                         ///< midpoint of every edge ever bisected
    int steps = 0;
    Generations cells;  ///< the cells after the last step
};

/// Repeats the steps. Throws InputError if they do not fit the cells, two cells disagree on an
/// edge, or a set of edges is not closed, that is, a face has a bisected edge but its longest is
/// not bisected.
[[nodiscard]] Lineage lineage_of(const Mesh& input, const StepCuts& steps);

/// Returns the cells that the steps create from the input if they bisect only edges whose midpoints
/// are in the set.
[[nodiscard]] Generations cells_with(const Lineage& lineage, const Mesh& input,
                                     const VertexSet& vertices);

}  // namespace octetra::verify
