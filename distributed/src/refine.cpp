#include <octetra/distributed/refine.hpp>

#include "refine_level.hpp"

namespace octetra::distributed {

SynchronisationCounts refine(DistributedMesh& mesh, const Selection& selection,
                             const RefineOptions& options) {
    SynchronisationCounts total;
    for (int level = 1; level <= options.levels; ++level) {
        const auto [counts, changed] = refine_level(mesh, selection, options, level);
        if (!changed) break;  // and so it would be at all further levels
        total.rounds += counts.rounds;
        total.messages += counts.messages;
        total.edges += counts.edges;
        const std::uint64_t cells = mesh.processes.sum(mesh.cells.size());
        if (options.on_level && mesh.processes.is_first()) options.on_level(level, cells);
    }
    return total;
}

}  // namespace octetra::distributed
