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

/// The way for few vertices that go: looks at the descendants of those roots (cells of the input)
/// that lose one, leaves all other entities where they are, and keeps the mesh's adjacency. Numbers
/// of vertices change all the same, behind the first that goes.
class IncrementalCoarsening {
public:
    /// Nothing if these descendants are too many for this way. The mesh has its adjacency.
    [[nodiscard]] static std::unique_ptr<IncrementalCoarsening> of(DistributedMesh& mesh,
                                                                   const KeptVertices& kept,
                                                                   const Tuning& tuning);

    /// What the lists become goes into the part, but for the lists themselves.
    void plan(const KeptVertices& kept, CoarserPart& part);
    /// The mesh's lists and its adjacency, by the new numbers of vertices; not yet the vertices.
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
