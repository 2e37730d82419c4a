#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/features.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "numbering/canonical_runs.hpp"

namespace octetra::distributed {

/// The canonical numbers of the entities with features, in slices: input vertices, and the
/// descendants of input edges, facets and cells with features.
class FeatureSlices {
public:
    /// The entities of one kind, in canonical order.
    struct Kind {
        const AncestorMap* ancestors;
        const CanonicalRuns* runs;
    };

    /// Collective. `kinds`: tagged edges, tagged facets, cells. The object keeps a reference only
    /// to the mesh's communicator.
    FeatureSlices(const DistributedMesh& mesh, const std::array<Kind, 3>& kinds);

    /// Equal on all processes.
    [[nodiscard]] const FeatureCounts& counts() const { return counts_; }
    /// Collective. See MeshSource::features().
    [[nodiscard]] std::span<const std::uint64_t> slice(Feature feature, const Window& window);

private:
    /// Entries from `first_entry` on of a list: the numbers begin .. begin + count - 1.
    struct Run {
        std::uint64_t first_entry;
        std::uint64_t begin;
        std::uint64_t count;
    };

    Communicator processes_;
    FeatureCounts counts_;
    PerFeature<std::vector<Run>> runs_;  ///< this process's share of each list
    std::vector<std::uint64_t> slice_;
};

}  // namespace octetra::distributed
