#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/verify/verify_coarsening.hpp>

#include "lookup/edge_table.hpp"

namespace octetra::verify {

/// One for each vertex of a lineage.
using VertexSet = IndexVector<VertexIndex, char>;

/// A cell that a step has cut, and the cut cell that it came from.
struct CutCell {
    CellVertices vertices;
    int step = 0;
    std::uint32_t parent = 0;  ///< in Generations::cut; or no_parent: a cell of the input
};
inline constexpr std::uint32_t no_parent = std::numeric_limits<std::uint32_t>::max();

struct PresentCell {
    CellVertices vertices;
    CellIndex root;  ///< of the input
    std::uint32_t parent = no_parent;
};

/// The cells of a mesh in the order of files, and all that were cut on the way to them.
struct Generations {
    std::vector<CutCell> cut;
    std::vector<PresentCell> present;
};

/// All vertices that steps have made of an input, by the numbers that they have in the mesh after
/// the last one: first the input's, then step by step the midpoints, in the order of (smaller,
/// larger) end of their edges.
struct Lineage {
    IndexVector<VertexIndex, Point> points;
    IndexVector<VertexIndex, int> step;  ///< that made it, from 1; 0: a vertex of the input
    IndexVector<VertexIndex, EdgeVertices> halves;  ///< none() for those of the input
    EdgeTable midpoints{0};                         ///< of every edge that was ever bisected
    int steps = 0;
    Generations cells;  ///< those after the last step
};

/// Repeats the steps. Throws InputError where they do not fit the cells, two cells disagree on an
/// edge, or a set of edges is not closed: a face has a bisected edge, and its longest is not.
[[nodiscard]] Lineage lineage_of(const Mesh& input, const StepCuts& steps);

/// What the steps make of the input if they bisect only the edges whose midpoints are in the set.
[[nodiscard]] Generations cells_with(const Lineage& lineage, const Mesh& input,
                                     const VertexSet& vertices);

}  // namespace octetra::verify
