#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <octetra/core/index.hpp>
#include <octetra/core/point.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

namespace octetra::dolfinx {

/// The data of DOLFINx's common::IndexMap: entities owned by this rank are numbered first, then
/// ghosts.
struct Numbering {
    std::int32_t own_count = 0;
    std::int64_t first = 0;            ///< global number of the first owned entity
    std::vector<std::int64_t> ghosts;  ///< global numbers of the ghosts
    std::vector<int> owners;           ///< owners of the ghosts
    std::vector<int> sources;          ///< distinct owners, ascending
    std::vector<int> destinations;     ///< ranks with ghosts owned by this rank, ascending
    /// False if there are ghosts of which their owner has no knowledge.
    bool knows_destinations = true;
};

/// The vertices and cells of this rank and of its ghost layer in the numbering of DOLFINx.
/// DOLFINx's create_mesh determines by messages which vertices ranks share and who owns them. The
/// AdaptiveMesh knows both, so only consecutive numbers are exchanged here. Cells keep their order.
struct Nodes {
    Numbering numbering;
    Numbering cell_numbering;
    std::vector<std::int32_t> of_vertex;    ///< the node of each vertex of this rank
    std::vector<VertexIndex> vertices;      ///< the vertex of each node; none() for ghost nodes
    std::vector<std::int32_t> ghost_cells;  ///< the four nodes of each ghost cell
};

/// Collective. `ghosts` may be null.
[[nodiscard]] Nodes number_nodes(const distributed::AdaptiveMesh& mesh,
                                 const distributed::GhostLayer* ghosts);

}  // namespace octetra::dolfinx
