#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/succession.hpp>

#include "coarsen/kept_vertices.hpp"
#include "level/incremental/adjacency.hpp"
#include "level/rounding_failure.hpp"

namespace octetra::distributed {

/// What a process's part becomes without the vertices that go.
struct CoarserPart {
    /// As long as the lists are not there, it has none, and no ancestors of them.
    DistributedMesh mesh;
    /// For each vertex that stays, the number that it had. All ascend still.
    std::vector<VertexIndex> vertices_before;
    /// The first that goes, or the end: those before it have their numbers still.
    VertexIndex first_gone;
    /// For each vertex of before, the number that it has, or would have if it stayed; and the end.
    IndexVector<VertexIndex, VertexIndex> vertex_after;
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
void drop_empty_levels(CoarserPart& part);

}  // namespace octetra::distributed
