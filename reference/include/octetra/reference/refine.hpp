#pragma once

#include <cstddef>
#include <limits>

#include <octetra/core/maps.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>

/// The serial 8T-LE refinement that defines what is right: Balman, "Tetrahedral Mesh Refinement in
/// Distributed Environments", Figure 3, without the distribution. Written to be checked by eye.
namespace octetra::reference {

inline constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

struct Refinement {
    Mesh mesh;
    RefinementMaps maps;
};

/// Repeats `levels` times: mark cells, mark their edges by `scheme`, close the set of edges,
/// bisect the marked edges, bisect the cells by them.
///
/// Cells of the result stand in the order of their parents, children in the order of bisection;
/// the input's vertices keep their numbers, the midpoints of a level follow in the order of their
/// edges' (smaller, larger) end point numbers.
/// Region tags go to the children, facets and their markers to the triangles that tile them, edges
/// and theirs to the halves; features of all of them likewise, and no midpoint has one. A midpoint
/// has the mean of its ends' attributes. Its marker is the edge's, where that is tagged; else the
/// smallest of the tagged facets around the edge; else 0.
///
/// The mesh must satisfy the invariants of struct Mesh. Throws InputError where a midpoint, rounded
/// to binary64, would flatten or invert a cell, where the result has more entities than can be
/// numbered, or before a level that would make more than `max_cells` cells.
[[nodiscard]] Refinement refine(const Mesh& mesh, const Selection& selection, Scheme scheme,
                                int levels, std::size_t max_cells = any_number);

}  // namespace octetra::reference
