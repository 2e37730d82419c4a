#include "level/refine_level.hpp"

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/profile.hpp>

#include "level/full_sweep/full_sweep_level.hpp"
#include "level/incremental/adjacency.hpp"
#include "level/incremental/incremental_level.hpp"
#include "level/synchronise.hpp"

namespace octetra::distributed {
namespace {

/// Collective. Throws on all processes if any would have more entities than 32 bits number.
void check_countable(const DistributedMesh& mesh, std::size_t count, const char* what) {
    if (mesh.processes.max(count) >= VertexIndex::limit) {
        throw InputError(fmt::format("the refined mesh would have more than {} {} on one process",
                                     VertexIndex::limit, what));
    }
}

/// Collective. Throws on all processes if the whole mesh would have more cells than allowed.
void check_allowed(const DistributedMesh& mesh, std::size_t count, const RefineOptions& options,
                   int level) {
    if (options.max_cells == std::numeric_limits<std::uint64_t>::max()) return;
    const std::uint64_t cells = mesh.processes.sum(count);
    if (cells <= options.max_cells) return;
    throw InputError(
        fmt::format("level {} would make {} cells, more than the {} allowed: mark fewer cells or "
                    "levels, or allow more",
                    level, cells, options.max_cells));
}

/// Would little change, because few cells are marked or they are all in one place? Edges
/// that marked cells mark concern five or six cells for each of their vertices.
bool suits_incremental_level(const DistributedMesh& mesh, const MarkedCells& marked,
                             const Tuning& tuning) {
    if (marked.all || !Adjacency::can_hold(mesh)) return false;
    const auto most = tuning.incremental_below * static_cast<double>(mesh.points.size());
    std::vector<bool> is_met(mesh.points.size(), false);
    std::size_t met = 0;
    for (const CellIndex c : marked.cells) {
        for (const VertexIndex v : mesh.cells[c]) {
            if (is_met[v.value()]) continue;
            is_met[v.value()] = true;
            if (static_cast<double>(++met) >= most) return false;
        }
    }
    return most > 0;
}

/// The level with edges of the marked cells marked. A full sweep numbers cells in order, so it
/// may have to mark again.
std::unique_ptr<Level> begin_level(DistributedMesh& mesh, const Selection& selection,
                                   const RefineOptions& options, const Tuning& tuning,
                                   MarkedCells marked) {
    if (suits_incremental_level(mesh, marked, tuning)) {
        auto level = std::make_unique<IncrementalLevel>(mesh);
        const Phase phase(mesh.processes, "select");
        level->mark(marked, options.scheme);
        return level;
    }
    if (mesh.adjacency != nullptr) {
        const Phase phase(mesh.processes, "select");
        restore_canonical_order(mesh);
        marked = mark_cells(mesh, selection, false);
    }
    auto level = std::make_unique<FullSweepLevel>(mesh, marked, tuning.local_below);
    const Phase phase(mesh.processes, "select");
    level->mark(marked, options.scheme);
    return level;
}

}  // namespace

LevelOutcome refine_level(DistributedMesh& mesh, const Selection& selection,
                          const RefineOptions& options, const Tuning& tuning, int level) {
    const Communicator& processes = mesh.processes;
    MarkedCells marked =
        in_phase(processes, "select", [&] { return mark_cells(mesh, selection, level > 1); });
    if (processes.max(marked.count) == 0) return {};
    const std::size_t judged = marked.judged;

    const auto way = begin_level(mesh, selection, options, tuning, std::move(marked));
    const auto counts = in_phase(processes, "synchronise", [&] {
        return options.synchronisation == Synchronisation::neighbour
                   ? synchronise_by_neighbours(way->closure(), mesh)
                   : synchronise_by_gateway(way->closure(), mesh);
    });

    check_countable(mesh, mesh.points.size() + way->closure().marked_count(), "vertices");
    in_phase(processes, "bisect edges", [&] { way->bisect_edges(); });
    {
        const Phase phase(processes, "bisect tetrahedra");
        const std::size_t cell_count = way->cell_count_afterwards();
        check_countable(mesh, cell_count, "cells");
        check_allowed(mesh, cell_count, options, level);
        way->bisect_cells(cell_count).agree(mesh, level);
        way->bisect_tagged();
    }
    in_phase(processes, "interfaces", [&] { way->bisect_interfaces(); });
    return {.counts = counts, .changed = true, .cells_touched = judged + way->cells_touched()};
}

}  // namespace octetra::distributed
