#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/succession.hpp>

#include "coarsen/kept_vertices.hpp"
#include "level/incremental/adjacency.hpp"
#include "level/rounding_failure.hpp"

namespace octetra::distributed {

/// A list (of cells, tagged facets or edges) as it is without the vertices that go, by their new
/// numbers.
template <class I, std::size_t N>
struct NewList {
    IndexVector<I, std::array<VertexIndex, N>> list;
    std::vector<std::uint32_t> first;  ///< as in AncestorMap
};

/// What a process's part becomes without the vertices that go.
struct CoarserPart {
    /// For each vertex that stays, the number that it had. All ascend still.
    std::vector<VertexIndex> vertices_before;
    /// The first that goes, or the end: those before it have their numbers still.
    VertexIndex first_gone;
    /// For each vertex of before, the number that it has, or would have if it stayed; and the end.
    IndexVector<VertexIndex, VertexIndex> vertex_after;
    std::vector<VertexIndex> level_begin;
    std::vector<Interface> interfaces;
    // Where the lists are made anew, and not edited where they are:
    NewList<CellIndex, 4> new_cells;
    NewList<FacetIndex, 3> new_facets;
    NewList<EdgeIndex, 2> new_edges;
    Succession cells;
    Succession facets;
    Succession edges;
    /// By level of before: a piece that rounding spoils.
    std::vector<RoundingFailure> failures;
};

/// Vertices, levels and interfaces; the levels are as many as before. Not collective.
[[nodiscard]] CoarserPart coarser_vertices(const DistributedMesh& mesh, const KeptVertices& kept);

/// Adds the lists of a mesh that `order` has brought into canonical order, in one pass over each.
/// Not collective.
void coarsen_lists(const DistributedMesh& mesh, const CanonicalOrder& order,
                   const KeptVertices& kept, CoarserPart& part);

/// Collective. Drops the levels of which no process has anything left, and throws on all processes
/// where rounding spoils a piece, by the level that it has then: as the history without the
/// vertices that went would do, replayed.
void drop_empty_levels(const DistributedMesh& mesh, CoarserPart& part);

/// Takes the vertices that go from the mesh, once its lists have been told, and gives memory back.
void commit_vertices(DistributedMesh& mesh, CoarserPart& part) noexcept;
void commit_new_lists(DistributedMesh& mesh, CoarserPart& part) noexcept;

}  // namespace octetra::distributed
