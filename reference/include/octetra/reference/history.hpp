#pragma once

#include <vector>

#include <octetra/core/closure.hpp>
#include <octetra/reference/refine.hpp>

/// A mesh as its input and the bisections applied to it. Coarsening removes bisections; replaying
/// the remaining ones produces the coarser mesh.
namespace octetra::reference {

struct History {
    Mesh input;
    /// For each step, the edges that it bisected: a nonempty closed set, in the order of (smaller,
    /// larger) end numbers. Vertices keep, in all later meshes, the numbers assigned at their
    /// creation.
    std::vector<std::vector<EdgeVertices>> steps;

    friend bool operator==(const History&, const History&) = default;
};

/// Returns the mesh before the first step, after it, and so on; the last one is the mesh of the
/// history. Each is bitwise equal to the mesh that refinement produced, with the same numbering.
/// Throws InputError as refine() does, where a step counts as a level.
[[nodiscard]] std::vector<Refinement> replay(const History& history,
                                             std::size_t max_cells = unlimited);

/// One element for each cell of a mesh: nonzero if the cell is marked.
using CellMarks = IndexVector<CellIndex, char>;

[[nodiscard]] CellMarks marked_cells(const Refinement& refined, const Selection& selection);

/// Applies one more level of refine() to the marked cells of the history's mesh. A step that
/// bisects no edge is not recorded.
[[nodiscard]] History refined(const History& history, const CellMarks& marked, Scheme scheme);

/// The same with Closure::regular and Scheme::eight. The history must have been made so.
///
/// A cell of the input is regular, of generation 0. If all six edges of a regular cell of
/// generation g are bisected, its eight children are regular, of generation g + 1. If one to five
/// are bisected, its children are transition cells, which are not bisected. The edges of regular
/// cells that are bisected are the least set B such that
///  (1) B contains the six edges of each marked regular cell and of the parent of each marked
///      transition cell; and if the latter is one of the eight children that its parent has when
///      all its edges are bisected, then its own edges, too;
///  (2) if B contains an edge of a face of a regular cell, it contains the face's longest edge;
///  (3) if B contains an edge of the four triangles into which a face of a regular cell is bisected
///      by all its edges, other than an edge of the face, it contains the cell's six edges.
/// Step g bisects the edges in B of the cells of generation g: refinement can add edges to earlier
/// steps, which changes the numbers of vertices.
[[nodiscard]] History refined_regularly(const History& history, const CellMarks& marked);

/// Coarsens the cells marked in `may_coarsen` by one generation each, where possible.
///
/// The vertices that are kept are the least set K such that
///  (a) K contains the vertices of the input, of every present cell that is not marked, and of
///      every cell that any step cut;
///  (b) if K contains the midpoint of an edge of step t, then for every face of the mesh before
///      step t that has this edge, K contains the midpoint of that face's longest edge.
/// Edges whose midpoints are removed are removed from their steps, and empty steps are dropped.
/// (b) is the rule of closure, so the rest of each step is closed. With Closure::regular, in
/// addition,
///  (c) if K contains the midpoint of an edge of a child of a cell, it contains all midpoints of
///  the
///      cell's edges: otherwise a transition cell would be bisected.
///
/// If midpoints were rounded, a cell without them may be flat or inverted although its children
/// were not: replay() of the result then throws.
[[nodiscard]] History coarsened(const History& history, const CellMarks& may_coarsen,
                                Closure closure = Closure::longest_edge);

}  // namespace octetra::reference
