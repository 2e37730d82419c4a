#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/closure.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/verify/verdict.hpp>
#include <octetra/verify/verify.hpp>

namespace octetra::verify {

/// The cells that coarsening was allowed to remove, by one step each, and the number of
/// repetitions.
struct CoarseningRequest {
    /// `cells` are indices in the mesh before coarsening, in file order; allowed only with a single
    /// level.
    Selection may_coarsen;
    bool outside = false;  ///< select the cells that `may_coarsen` does not mark instead
    /// The criteria are applied to the coarser mesh each time, until nothing changes.
    int levels = 1;
    Closure closure = Closure::longest_edge;  ///< of the steps
};

/// For each step and each cell before it, the edges that the step bisected: six bits, in the order
/// of cell_edges. Cells are in file order: children in the place of their parent, in the order of
/// bisection. These are the contents of a checkpoint.
using StepCuts = std::vector<std::vector<std::uint8_t>>;

/// Verifies `after` as the result of coarsening the mesh that these steps created from `input`.
///
/// A valid verdict proves the properties of verify_refinement(input, after), and
///  - the vertices are exactly those of the mesh before that the rules of coarsening keep, applied
///    `levels` times. A vertex is kept if it belongs to a cell that must not be coarsened, or to a
///    cell that has a vertex of a later step (a); and if it is the midpoint of the longest edge of
///    a face another edge of which has a midpoint, of the same step, that is kept (b); and, with
///    Closure::regular, if it is the midpoint of an edge of a cell, and a midpoint of an edge of a
///    child of this cell is kept (c);
///  - each cell is a cell of the mesh before, or a union of cells into which one step, or at most
///    as many steps as there are levels, divided it;
///  - each cell is the one that longest-edge bisection creates from the edges whose midpoints are
///    kept.
/// The numbering is not verified: vertices are matched by number if `after` has the kept vertices
/// in their order, otherwise by coordinates. (If vertices coincide, for instance at a crack, and
/// numbers differ, vertices may be confused, and a correct mesh rejected.)
///
/// The steps are assumed to have been made. Throws InputError if they do not fit the mesh, disagree
/// on edges shared by cells or are not closed; if the request lists cells that do not exist, or any
/// with more than one level; or if there are more vertices than can be numbered. `options.request`
/// is ignored.
///
/// Time: that of verify_refinement(), and some passes over the cells for each step and level.
/// Memory: the mesh before, and all cells that its steps divided.
[[nodiscard]] Verdict verify_coarsening(const Mesh& input, const StepCuts& steps,
                                        const CoarseningRequest& request, const Mesh& after,
                                        const VerifyOptions& options = {});

}  // namespace octetra::verify
