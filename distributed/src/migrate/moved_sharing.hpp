#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sharing.hpp>

#include "assemble/departures.hpp"

namespace octetra::distributed {

/// An input vertex and a process that will have it.
struct VertexDestination {
    GlobalVertex vertex{};
    int rank = 0;

    friend auto operator<=>(const VertexDestination&, const VertexDestination&) = default;
};

/// Returns the destinations, sorted by vertex and rank, of this process's cells at vertices that
/// are shared or have a departing cell. `sharing` is that before the migration. Not collective.
[[nodiscard]] std::vector<VertexDestination> vertex_destinations(
    const Departures& departures, const Sharing<VertexIndex>& sharing);

/// Collective. Returns the sharing of the input vertices after a migration; `after` has no levels.
/// The previous owner of each vertex receives the destinations of the cells at it, and sends them
/// to the processes that will have the vertex. So messages are sent to previous neighbours, and
/// from these to destinations of cells.
[[nodiscard]] Sharing<VertexIndex> moved_sharing(
    const DistributedMesh& after, const Sharing<VertexIndex>& before,
    const std::vector<GlobalVertex>& vertices_before,
    const std::vector<VertexDestination>& destinations);

}  // namespace octetra::distributed
