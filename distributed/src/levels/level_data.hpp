#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <octetra/distributed/levels.hpp>

#include "history/vertex_levels.hpp"

namespace octetra::distributed {

/// The finest level with its history, and which prefix of its vertices each level has.
struct Levels::Data {
    struct Level {
        std::size_t step = 0;
        std::uint64_t vertex_count = 0;  ///< of the whole level
        std::size_t vertices = 0;        ///< of this process
        Sharing<VertexIndex> sharing;
    };

    /// A copy of the mesh in canonical order, without interfaces; it cannot be refined.
    DistributedMesh finest;
    /// The numbers that its entities have in the mesh; empty if they are the same.
    std::vector<CellIndex> cells_before;
    std::vector<FacetIndex> facets_before;
    std::vector<EdgeIndex> edges_before;
    std::vector<GlobalVertex> vertex_numbers;
    std::vector<Level> levels;

    /// Throws InputError if there is no such level.
    [[nodiscard]] const Level& at(std::size_t level) const;
    [[nodiscard]] VertexLevels steps() const { return VertexLevels(finest); }
};

}  // namespace octetra::distributed
