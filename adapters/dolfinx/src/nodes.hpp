#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <octetra/core/index.hpp>
#include <octetra/core/point.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

namespace octetra::dolfinx {

/// What DOLFINx's common::IndexMap takes: things of this rank's own are numbered first, then those
/// that others own.
struct Numbering {
    std::int32_t own_count = 0;
    std::int64_t first = 0;            ///< the number in the whole mesh of this rank's first own
    std::vector<std::int64_t> ghosts;  ///< of the others, their numbers in the whole mesh
    std::vector<int> owners;           ///< and who has them
    std::vector<int> sources;          ///< these ranks, each once, ascending
    std::vector<int> destinations;     ///< ranks that have some of this one's own, ascending
    /// Are there ghosts of which their owner does not know?
    bool knows_destinations = true;
};

/// Vertices and cells of this rank, and of its ghost cells, as DOLFINx numbers them.
/// DOLFINx's create_mesh determines by messages which vertices ranks share and who owns them. The
/// AdaptiveMesh knows both, so only consecutive numbers are exchanged here. Cells keep their order.
struct Nodes {
    Numbering numbering;
    Numbering cell_numbering;
    std::vector<std::int32_t> of_vertex;    ///< the node of each vertex of this rank
    std::vector<VertexIndex> vertices;      ///< the vertex of each node; none behind those
    std::vector<std::int32_t> ghost_cells;  ///< the four nodes of each ghost cell
};

/// Collective. `ghosts` may be null: none.
[[nodiscard]] Nodes number_nodes(const distributed::AdaptiveMesh& mesh,
                                 const distributed::GhostLayer* ghosts);

}  // namespace octetra::dolfinx
