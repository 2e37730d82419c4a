#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "coarsen/kept_vertices.hpp"
#include "level/rounding_failure.hpp"

namespace octetra::distributed {

/// What a process's part becomes without the vertices that go.
struct CoarserPart {
    DistributedMesh mesh;
    /// For each vertex that stays, the number that it had. All ascend still.
    std::vector<VertexIndex> vertices_before;
    /// For each cell, facet, tagged edge of before, the one that it is or is a piece of, and how
    /// often a cell was halved for it.
    std::vector<std::uint32_t> cell_after;
    std::vector<std::uint8_t> halvings;
    std::vector<std::uint32_t> facet_after;
    std::vector<std::uint32_t> edge_after;
    /// By level of before: a piece that rounding spoils.
    std::vector<RoundingFailure> failures;
};

/// Not collective. Of a mesh in canonical order. Its levels are as many as before.
[[nodiscard]] CoarserPart coarser_part(const DistributedMesh& mesh, const KeptVertices& kept);

/// Collective. Drops the levels of which no process has anything left, and throws on all processes
/// where rounding spoils a piece, by the level that it has then: as the history without the
/// vertices that went would do, replayed.
void drop_empty_levels(CoarserPart& part);

}  // namespace octetra::distributed
