#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/incremental/shared_entities.hpp"
#include "level/incremental/unordered_list.hpp"
#include "mark/cell_blocks.hpp"

namespace octetra::distributed {

/// Data of a process for incremental levels: the entities at each vertex, and the canonical order.
/// Updated by each level where the mesh changes.
///
/// Memory: about 60 bytes per cell.
struct Adjacency {
    /// Returns the data of a mesh, with the index; creates them if necessary.
    static Adjacency& of(DistributedMesh& mesh);

    /// The mesh must be in canonical order. Reserves capacity in its lists as well.
    explicit Adjacency(DistributedMesh& mesh);

    /// Frees the index by which entities at a vertex are found, which is most of the memory, while
    /// it is not needed.
    void drop_index() noexcept;
    /// Creates the index again if necessary.
    void make_index(const DistributedMesh& mesh);

    /// Returns whether a mesh of this size can be indexed after any level.
    [[nodiscard]] static bool can_hold(const DistributedMesh& mesh);

    void set_vertex_count(std::size_t count);

    UnorderedList<CellIndex, 4> cells;
    UnorderedList<FacetIndex, 3> facets;
    UnorderedList<EdgeIndex, 2> edges;
    SharedEntities<2> shared_edges;
    SharedEntities<3> shared_faces;
    CellBlocks blocks;
    /// The index of each cell's note during a level; none() between levels.
    IndexVector<CellIndex, std::uint32_t> cell_to_note;
    /// The cells that the last level created.
    std::vector<CellIndex> new_cells;
    bool has_index = true;
};

/// Returns the next cell in canonical order, or none() after the last one. If the mesh is
/// unordered, the last descendant of each root has no next one.
[[nodiscard]] inline CellIndex next_cell(const DistributedMesh& mesh, CellIndex cell) {
    if (mesh.adjacency != nullptr) return mesh.adjacency->cells.next(cell);
    const CellIndex next{cell.value() + std::size_t{1}};
    return next < mesh.cells.end_index() ? next : CellIndex::none();
}

/// Puts a mesh into canonical order during its lifetime; the destructor restores the previous order
/// unless keep() was called. Not collective.
class CanonicalOrder {
public:
    /// If this throws, the mesh is unchanged.
    explicit CanonicalOrder(DistributedMesh& mesh);
    ~CanonicalOrder();
    CanonicalOrder(const CanonicalOrder&) = delete;
    CanonicalOrder& operator=(const CanonicalOrder&) = delete;
    CanonicalOrder(CanonicalOrder&&) = delete;
    CanonicalOrder& operator=(CanonicalOrder&&) = delete;

    void keep() noexcept;

    /// The previous number of each cell, facet and tagged edge; empty if the order is the same.
    [[nodiscard]] const std::vector<CellIndex>& cells_before() const { return cells_.before; }
    [[nodiscard]] const std::vector<FacetIndex>& facets_before() const { return facets_.before; }
    [[nodiscard]] const std::vector<EdgeIndex>& edges_before() const { return edges_.before; }

private:
    void swap_lists() noexcept;

    DistributedMesh* mesh_;
    // The order that the mesh is not in at present.
    decltype(Adjacency::cells)::Ordered cells_;
    decltype(Adjacency::facets)::Ordered facets_;
    decltype(Adjacency::edges)::Ordered edges_;
    decltype(DistributedMesh::adjacency) adjacency_;
};

}  // namespace octetra::distributed
