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

/// The canonical numbers of what has the features of a mesh, in slices: vertices of the input, and
/// the pieces of what else had them in the input.
class FeatureSlices {
public:
    /// A kind of entity, in canonical order.
    struct Kind {
        const AncestorMap* ancestors;
        const CanonicalRuns* runs;
    };

    /// Collective. `kinds`: tagged edges, tagged facets, cells. Refers to nothing of it afterwards
    /// but the mesh's processes.
    FeatureSlices(const DistributedMesh& mesh, const std::array<Kind, 3>& kinds);

    /// The same on all processes.
    [[nodiscard]] const FeatureCounts& counts() const { return counts_; }
    /// Collective. See MeshSource::features().
    [[nodiscard]] std::span<const std::uint64_t> slice(Feature feature, const Window& window);

private:
    /// Numbers begin .. begin+count-1, at this place and the following of a list.
    struct Run {
        std::uint64_t place;
        std::uint64_t begin;
        std::uint64_t count;
    };

    Communicator processes_;
    FeatureCounts counts_;
    PerFeature<std::vector<Run>> runs_;  ///< this process's part of each list
    std::vector<std::uint64_t> slice_;
};

}  // namespace octetra::distributed
