#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// States which lists of tags the input has; a process without entities of a kind cannot determine
/// this alone.
struct HasLists {
    bool regions = false;
    bool facet_markers = false;
    bool edge_markers = false;

    /// Collective.
    explicit HasLists(const DistributedMesh& mesh) {
        std::array<std::uint64_t, 3> has{mesh.cell_ancestors.markers.empty() ? 0U : 1U,
                                         mesh.facet_ancestors.markers.empty() ? 0U : 1U,
                                         mesh.edge_ancestors.markers.empty() ? 0U : 1U};
        mesh.processes.max(std::span<std::uint64_t>(has));
        regions = has[0] != 0;
        facet_markers = has[1] != 0;
        edge_markers = has[2] != 0;
    }
};

}  // namespace octetra::distributed
