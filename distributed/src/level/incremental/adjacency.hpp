#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/incremental/shared_entities.hpp"
#include "level/incremental/unordered_list.hpp"
#include "mark/cell_blocks.hpp"

namespace octetra::distributed {

/// What a process knows beyond the mesh while few of its cells change: who is at each vertex, and
/// the canonical order. It is kept up from level to level where something changes.
///
/// Memory: some 50 bytes per cell.
struct Adjacency {
    /// Makes room in the mesh's lists, too.
    explicit Adjacency(DistributedMesh& mesh);

    /// Can a mesh of this size be indexed, whatever a level makes of it?
    [[nodiscard]] static bool can_hold(const DistributedMesh& mesh);

    void add_vertices(std::size_t count);

    UnorderedList<CellIndex, 4> cells;
    UnorderedList<FacetIndex, 3> facets;
    UnorderedList<EdgeIndex, 2> edges;
    SharedEntities<2> shared_edges;
    SharedEntities<3> shared_faces;
    CellBlocks blocks;
    /// Room for a level's notes about the cells that it touches; none() between levels.
    IndexVector<CellIndex, std::uint32_t> cell_to_note;
    /// The cells that the last level made.
    std::vector<CellIndex> new_cells;
};

}  // namespace octetra::distributed
