#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "coarsen/coarser_part.hpp"
#include "coarsen/kept_vertices.hpp"
#include "coarsen/list_edit.hpp"
#include "level/incremental/adjacency.hpp"
#include "level/tuning.hpp"

namespace octetra::distributed {

/// Coarsening for few removed vertices: processes the descendants of the roots (cells of the input)
/// that lose a vertex, does not move other entities, and keeps the mesh's Adjacency up to date.
/// Vertices after the first removed one are renumbered nevertheless.
class IncrementalCoarsening {
public:
    /// Returns null if there are too many such descendants. The mesh must have its Adjacency.
    [[nodiscard]] static std::unique_ptr<IncrementalCoarsening> of(DistributedMesh& mesh,
                                                                   const KeptVertices& kept,
                                                                   const Tuning& tuning);

    /// Stores the changes of the lists in `part`, but not the lists themselves.
    void plan(const KeptVertices& kept, CoarserPart& part);
    /// Updates the mesh's lists and its Adjacency to the new vertex numbers, but not the vertices.
    void commit(const CoarserPart& part) noexcept;

private:
    explicit IncrementalCoarsening(DistributedMesh& mesh);

    DistributedMesh* mesh_;
    Adjacency* adjacency_;
    ListEdit<CellIndex, 4> cells_;
    ListEdit<FacetIndex, 3> facets_;
    ListEdit<EdgeIndex, 2> edges_;
    std::vector<std::size_t> changed_blocks_;  ///< of the adjacency's CellBlocks
    SharedEntities<2> shared_edges_;
    SharedEntities<3> shared_faces_;
};

}  // namespace octetra::distributed
