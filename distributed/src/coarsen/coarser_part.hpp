#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/entity_transfer.hpp>

#include "coarsen/kept_vertices.hpp"
#include "level/incremental/adjacency.hpp"
#include "level/rounding_failure.hpp"

namespace octetra::distributed {

/// A list (of cells, tagged facets or edges) after the removal of vertices, in terms of the new
/// vertex numbers.
template <class I, std::size_t N>
struct NewList {
    IndexVector<I, std::array<VertexIndex, N>> list;
    std::vector<std::uint32_t> first;  ///< as in AncestorMap
};

/// The part of a process after the removal of vertices.
struct CoarserPart {
    /// The previous number of each remaining vertex, ascending.
    std::vector<VertexIndex> vertices_before;
    /// The first removed vertex, or the end: vertices before it keep their numbers.
    VertexIndex first_removed;
    /// For each previous vertex, its number, or the number that it would have if it were kept; and
    /// the end.
    IndexVector<VertexIndex, VertexIndex> vertex_after;
    std::vector<VertexIndex> level_begin;
    std::vector<Interface> interfaces;
    // Lists that are rebuilt, if they are not edited in place:
    NewList<CellIndex, 4> new_cells;
    NewList<FacetIndex, 3> new_facets;
    NewList<EdgeIndex, 2> new_edges;
    EntityTransfer cells;
    EntityTransfer facets;
    EntityTransfer edges;
    /// For each previous level, a child that is flat or inverted by rounding.
    std::vector<RoundingFailure> failures;
};

/// Computes vertices, levels and interfaces; the number of levels is unchanged. Not collective.
[[nodiscard]] CoarserPart coarser_vertices(const DistributedMesh& mesh, const KeptVertices& kept);

/// Adds the lists of a mesh that `order` has put into canonical order, in one pass over each. Not
/// collective.
void coarsen_lists(const DistributedMesh& mesh, const CanonicalOrder& order,
                   const KeptVertices& kept, CoarserPart& part);

/// Collective. Removes the levels in which no process has vertices any more, and throws on all
/// processes if rounding makes a child flat or inverted, with the level after the removal: the same
/// as a replay of the history without the removed vertices.
void drop_empty_levels(const DistributedMesh& mesh, CoarserPart& part);

/// Removes vertices from the mesh after its lists were committed, and frees memory.
void commit_vertices(DistributedMesh& mesh, CoarserPart& part) noexcept;
void commit_new_lists(DistributedMesh& mesh, CoarserPart& part) noexcept;

}  // namespace octetra::distributed
