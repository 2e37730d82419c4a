#include <octetra/distributed/profile.hpp>
#include <octetra/distributed/refine.hpp>

#include "refine_level.hpp"

namespace octetra::distributed {

SynchronisationCounts refine(DistributedMesh& mesh, const Selection& selection,
                             const RefineOptions& options) {
    SynchronisationCounts total;
    note_cells(mesh.processes, 0, mesh.cells.size(), 0);
    for (int level = 1; level <= options.levels; ++level) {
        const Phase phase(mesh.processes, "level", level);
        const auto [counts, changed, touched] = refine_level(mesh, selection, options, level);
        if (!changed) break;  // and so it would be at all further levels
        total.rounds += counts.rounds;
        total.messages += counts.messages;
        total.bytes += counts.bytes;
        total.edges += counts.edges;
        note_cells(mesh.processes, level, mesh.cells.size(), touched);
        const std::uint64_t cells = mesh.processes.sum(mesh.cells.size());
        if (options.on_level && mesh.processes.is_first()) options.on_level(level, cells);
    }
    return total;
}

}  // namespace octetra::distributed
