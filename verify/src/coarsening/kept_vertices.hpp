#pragma once

#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/verify/verify_coarsening.hpp>

#include "coarsening/lineage.hpp"

namespace octetra::verify {

/// The reason why a vertex is kept.
struct Reason {
    enum class Why : std::uint8_t {
        none,     ///< it is removed, or not present
        input,    ///< it is in the input, or no level could remove it
        cell,     ///< it belongs to `cell`, which may not be coarsened
        cut,      ///< it and a vertex of a later step belong to `cell`
        closure,  ///< the same step created `vertex`, which is kept, on another edge of a face, and
                  ///< this vertex is the midpoint of the face's longest edge
        child,  ///< it halves an edge of a cell, `vertex` one of the child `cell`; regular closure
    };
    Why why = Why::none;
    CellVertices cell{};
    VertexIndex vertex;
};
using Reasons = IndexVector<VertexIndex, Reason>;

/// Returns which vertices of a mesh are kept if the cells marked in `may_coarsen` may be coarsened
/// by one step each. `cells` are created from some of the vertices of the lineage.
///
/// The rules refer to the meshes before each step; this function derives them from the present
/// cells alone. Every cell created by a step has a vertex of this step.
///  - A cell with vertex v was cut by a step later than that of v if and only if a present cell
///    contains v and a vertex of a later step. For some piece of the cell contains v, and so on,
///    down to a present cell; and those vertices of a cell that do not belong to the step which
///    created it are vertices of the cell that this step cut.
///  - A face of a cell that a step cut, with its longest edge e and another edge f bisected, was
///    bisected at e first, so their midpoints were joined; if they are no longer joined, a later
///    step has cut a cell that contains both, and both are kept by rule (a). Conversely, two joined
///    midpoints of one step were created on edges of one cell. If these edges share a corner, they
///    lie in one of its faces, and one of them is the longest edge there: midpoints of other edges
///    of a face are not joined.
[[nodiscard]] Reasons keep_reasons(const Lineage& lineage, const Generations& cells,
                                   const std::vector<char>& may_coarsen, Closure closure);

/// The result after all levels of the request.
struct Remainder {
    Reasons reasons;  ///< of the last level processed; none: removed at some level
    Generations cells;
};

/// Throws InputError for a list of cells that does not fit.
[[nodiscard]] Remainder remainder_of(const Lineage& lineage, const Mesh& input,
                                     const CoarseningRequest& request);

}  // namespace octetra::verify
