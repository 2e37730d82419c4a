#pragma once

#include <cstddef>
#include <limits>

#include <octetra/core/maps.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>

/// The serial 8T-LE refinement that defines the correct result: Balman, "Tetrahedral Mesh
/// Refinement in Distributed Environments", Figure 3, without the distribution. Simple enough to be
/// checked by inspection.
namespace octetra::reference {

inline constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

struct Refinement {
    Mesh mesh;
    RefinementMaps maps;
};

/// Repeats `levels` times: mark cells, mark their edges by `scheme`, close the set of edges,
/// bisect the marked edges, bisect the cells by them.
///
/// Cells of the result are in the order of their parents, children in the order of bisection. The
/// input's vertices keep their numbers; the midpoints of a level follow in the order of their
/// edges' (smaller, larger) end numbers.
/// Children inherit region tags; facet markers are inherited by the triangles that tile the facet,
/// edge markers by the halves; features likewise, except that midpoints have none. The attributes
/// of a midpoint are the means of those of its ends. Its marker is that of the edge, if tagged;
/// otherwise the smallest marker of the tagged facets around the edge; otherwise 0.
///
/// Precondition: the mesh satisfies the invariants of struct Mesh. Throws InputError if a midpoint,
/// rounded to binary64, would make a cell flat or inverted, if the result has more entities than
/// can be numbered, or before a level that would make more than `max_cells` cells.
[[nodiscard]] Refinement refine(const Mesh& mesh, const Selection& selection, Scheme scheme,
                                int levels, std::size_t max_cells = unlimited);

/// The same with Closure::regular and Scheme::eight; see refined_regularly(). `max_cells` applies
/// to the mesh after each level.
[[nodiscard]] Refinement refine_regularly(const Mesh& mesh, const Selection& selection, int levels,
                                          std::size_t max_cells = unlimited);

}  // namespace octetra::reference
