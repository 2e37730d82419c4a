#pragma once

#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/verify/verify_coarsening.hpp>

#include "coarsening/lineage.hpp"

namespace octetra::verify {

/// Why a vertex stays.
struct Reason {
    enum class Why : std::uint8_t {
        none,     ///< it goes, or is not there
        input,    ///< it is one of the input, or there is no level at which it could go
        cell,     ///< `cell` has it, and may not go
        cut,      ///< `cell` has it and a vertex of a later step, which cut a cell that has it
        closure,  ///< the same step put `vertex`, which stays, on another edge of a face of which
                  ///< this one is on the longest
    };
    Why why = Why::none;
    CellVertices cell{};
    VertexIndex vertex;
};
using Reasons = IndexVector<VertexIndex, Reason>;

/// Which vertices stay of a mesh, if these of its cells may go, one step each. `present` are the
/// cells that some of the vertices of the lineage make.
///
/// The rules are about the meshes before each step; here they are read off the cells that there
/// are. Every cell that a step makes has a vertex of this step.
///  - A cell with vertex v was cut by a later step than made v exactly if a cell that there is has
///    v and a vertex of a later step. For some piece of it has v, and so on, down to a cell that
///    there is; and a cell's vertices that the step which made it did not make are those of the
///    cell that it cut.
///  - A face of a cell that a step cut, with its longest edge e and another one, f, bisected, is
///    bisected at e first; so their midpoints are joined, and if they are no more, a later step has
///    cut a cell that has both, and both stay anyway. And two midpoints of one step that are joined
///    were put on edges of one cell; if these share a corner, they lie in one of its faces, and
///    one of them is the longest there: no other edges of a face have their midpoints joined.
[[nodiscard]] Reasons reasons_to_stay(const Lineage& lineage,
                                      const std::vector<PresentCell>& present,
                                      const std::vector<char>& may_go);

/// What is left when all levels of the request are done.
struct Remainder {
    Reasons reasons;  ///< of the last level that was looked at; none: gone at some level
    Generations cells;
};

/// Throws InputError for a list of cells that does not fit.
[[nodiscard]] Remainder remainder_of(const Lineage& lineage, const Mesh& input,
                                     const CoarseningRequest& request);

}  // namespace octetra::verify
