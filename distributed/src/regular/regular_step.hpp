#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/refine.hpp>

#include "level/marked_cells.hpp"
#include "regular/descent.hpp"

namespace octetra::distributed {

/// A step of refinement with Closure::regular, on this process.
struct RegularStep {
    bool changes_anything = false;  ///< on any process; otherwise the following are empty
    DistributedMesh mesh;           ///< after the step, in canonical order
    Descent cells;
    Descent facets;
    Descent edges;
    /// The number before the step of each vertex after it; none() for new vertices.
    std::vector<VertexIndex> vertices_before;
    /// The ends of the edge of which each new vertex is the midpoint, lower first, by their numbers
    /// after the step.
    std::vector<EdgeVertices> new_vertex_ends;
    SynchronisationCounts counts;
};

/// Collective, within a transaction. Refines a mesh in canonical order, which was refined with
/// Closure::regular only, or not at all; the mesh itself does not change. Throws InputError if a
/// rounded midpoint would make a cell flat or inverted, also one that the step bisects further, or
/// if the result would have more than RefineOptions::max_cells cells.
///
/// The set B of bisected edges, as defined by reference::refined_regularly(), is extended by rules
/// that only need the present cells. An edge has the generation of the regular cells with it. If an
/// edge of a transition cell is marked that is not an edge of its parent, then the family is
/// completed: all edges of the parent are marked, which are of the previous generation (3). A face
/// of the parent that is still whole has its longest edge marked if it has a marked edge (2).
///
/// Levels then bisect the edges of one generation each, beginning with the lowest: larger closed
/// sets of edges of a cell divide it into pieces of the pieces that smaller ones divide it into.
/// New regular cells can cause marks of higher generations, and these can complete further
/// families, whose edges are bisected before.
[[nodiscard]] RegularStep regular_step(const DistributedMesh& mesh, const MarkedCells& marked,
                                       const RefineOptions& options);

}  // namespace octetra::distributed
