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
/// Memory: some 60 bytes per cell.
struct Adjacency {
    /// That of a mesh, with its index, made if it is not there.
    static Adjacency& of(DistributedMesh& mesh);

    /// Of a mesh in canonical order. Makes room in its lists, too.
    explicit Adjacency(DistributedMesh& mesh);

    /// Gives back what finds entities at a vertex, most of the memory, for as long as it is not
    /// needed.
    void drop_index() noexcept;
    /// Makes it again, if it is not there.
    void make_index(const DistributedMesh& mesh);

    /// Can a mesh of this size be indexed, whatever a level makes of it?
    [[nodiscard]] static bool can_hold(const DistributedMesh& mesh);

    void set_vertex_count(std::size_t count);

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
    bool has_index = true;
};

/// A mesh in canonical order for as long as this lives; then it is again as it was, unless it is to
/// be kept so. Not collective.
class CanonicalOrder {
public:
    /// Where this throws, the mesh is as it was.
    explicit CanonicalOrder(DistributedMesh& mesh);
    ~CanonicalOrder();
    CanonicalOrder(const CanonicalOrder&) = delete;
    CanonicalOrder& operator=(const CanonicalOrder&) = delete;
    CanonicalOrder(CanonicalOrder&&) = delete;
    CanonicalOrder& operator=(CanonicalOrder&&) = delete;

    void keep() noexcept;

    /// The number that each cell, facet and tagged edge had before; empty where it is the same.
    [[nodiscard]] const std::vector<CellIndex>& cells_before() const { return cells_.before; }
    [[nodiscard]] const std::vector<FacetIndex>& facets_before() const { return facets_.before; }
    [[nodiscard]] const std::vector<EdgeIndex>& edges_before() const { return edges_.before; }

private:
    void swap_lists() noexcept;

    DistributedMesh* mesh_;
    // Of the order that the mesh is not in.
    decltype(Adjacency::cells)::Ordered cells_;
    decltype(Adjacency::facets)::Ordered facets_;
    decltype(Adjacency::edges)::Ordered edges_;
    decltype(DistributedMesh::adjacency) adjacency_;
};

}  // namespace octetra::distributed
