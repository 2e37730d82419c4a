#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sharing.hpp>

#include "migrate/departures.hpp"

namespace octetra::distributed {

/// A vertex of the input that some process will have.
struct VertexDestination {
    GlobalVertex vertex{};
    int rank = 0;

    friend auto operator<=>(const VertexDestination&, const VertexDestination&) = default;
};

/// By vertex and rank, of the vertices that this process shares or whose cells do not all stay:
/// where its cells at them go. `sharing` is that of before. Not collective.
[[nodiscard]] std::vector<VertexDestination> vertex_destinations(
    const Departures& departures, const Sharing<VertexIndex>& sharing);

/// Collective. Who has the vertices of the input after a move; `after` is as the input was. Of each
/// vertex its owner before hears where the cells at it go, and tells those that get it: messages go
/// to neighbours of before, and from there to whom cells go. Throws alike on all processes.
[[nodiscard]] Sharing<VertexIndex> moved_sharing(
    const DistributedMesh& after, const Sharing<VertexIndex>& before,
    const std::vector<GlobalVertex>& vertices_before,
    const std::vector<VertexDestination>& destinations);

}  // namespace octetra::distributed
