#pragma once

#include <vector>

#include <octetra/reference/refine.hpp>

/// A mesh as its input and what was done to it. Coarsening edits what was done; the coarser mesh is
/// what replay makes of the rest.
namespace octetra::reference {

struct History {
    Mesh input;
    /// For each step, the edges that it bisected: a closed set, not empty, in the order of
    /// (smaller, larger) end point numbers. Vertices have the numbers that they got when they were
    /// made and keep in all later meshes.
    std::vector<std::vector<EdgeVertices>> steps;

    friend bool operator==(const History&, const History&) = default;
};

/// The mesh before the first step, after it, and so on: the last one is the history's. Each has
/// every number and bit that refinement gave it. Throws InputError as refine() does, a step being a
/// level.
[[nodiscard]] std::vector<Refinement> replay(const History& history,
                                             std::size_t max_cells = any_number);

/// One for each cell of a mesh: not 0 where it is marked.
using CellMarks = IndexVector<CellIndex, char>;

[[nodiscard]] CellMarks marked_cells(const Refinement& refined, const Selection& selection);

/// One level of refine() more, of the marked cells of the history's mesh. A step that bisects no
/// edge leaves no trace.
[[nodiscard]] History refined(const History& history, const CellMarks& marked, Scheme scheme);

/// What is left when the cells that `may_go` marks may go back by one generation each.
///
/// The vertices that stay are the least set K such that
///  (a) K has the vertices of the input, of every present cell that is not marked, and of every
///      cell that any step cut;
///  (b) with the midpoint of an edge of step t, for every face of the mesh before step t that has
///      the edge, K has the midpoint of that face's longest edge.
/// The edges whose midpoints go are struck from their steps, and steps without edges are dropped.
/// (b) is the rule of closure, so what is left of each step is closed.
///
/// Where midpoints were rounded, a cell without them may be flat or inverted though what it was cut
/// into was not: then replay() of what is left throws.
[[nodiscard]] History coarsened(const History& history, const CellMarks& may_go);

}  // namespace octetra::reference
