#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/verify/verdict.hpp>
#include <octetra/verify/verify.hpp>

namespace octetra::verify {

/// Which cells may go, one step each, and how often that was asked for.
struct CoarseningRequest {
    /// `cells` are those of the mesh before, in the order of files, and go with one level alone.
    Selection may_go;
    bool outside = false;  ///< rather all cells that the selection does not mark
    /// The criteria judge the coarser mesh afresh each time, until nothing changes.
    int levels = 1;
};

/// For each step, of each cell before it, the edges that the step bisected: six bits, in the order
/// of cell_edges. Cells stand in the order of files: children where their parent stood, in the
/// order of the bisection. What a checkpoint holds.
using StepCuts = std::vector<std::vector<std::uint8_t>>;

/// Judges `after` as what coarsening leaves of the mesh that these steps have made of `input`.
///
/// A valid verdict proves what that of verify_refinement(input, after) proves, and
///  - the vertices are those of the mesh before that the rules of coarsening keep, and no others.
///    With levels: what the rules, applied so often, keep. A vertex stays that a cell has which may
///    not go, or which has a vertex of a later step (a); and a midpoint of the longest edge of a
///    face of which another edge's midpoint, of the same step, stays (b);
///  - each cell is one of the mesh before, or a union of such that a step, or as many as there are
///    levels, have cut it into;
///  - and it is the one that bisection by the longest edges makes of the edges whose midpoints
///    stay.
/// No numbers are judged: vertices are found by number, if `after` has those that stay in their
/// order, else by place. (Where vertices lie at one place, as at a crack, other numbers than those
/// may be taken for one another, and the right mesh refused.)
///
/// Of the steps it is taken for true that they were made; that they fit the mesh, agree on the
/// edges that cells share, and are closed is checked: else it throws InputError. So it does where
/// cells are listed that there are not, or with more than a level, or for more vertices than can be
/// numbered. `options.request` is not looked at.
///
/// Takes the time of verify_refinement(), and for each step and level some passes through the
/// cells; the memory of the mesh before and of all the cells that its steps have cut.
[[nodiscard]] Verdict verify_coarsening(const Mesh& input, const StepCuts& steps,
                                        const CoarseningRequest& request, const Mesh& after,
                                        const VerifyOptions& options = {});

}  // namespace octetra::verify
