#include <algorithm>
#include <optional>
#include <utility>

#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/mesh_state.hpp"
#include "coarsen/coarser_numbers.hpp"
#include "coarsen/coarser_part.hpp"
#include "coarsen/incremental_coarsening.hpp"
#include "coarsen/kept_vertices.hpp"
#include "coarsen/removed_vertices.hpp"
#include "level/incremental/adjacency.hpp"
#include "level/incremental/suits_incremental_level.hpp"
#include "sharing/sharing_builder.hpp"

namespace octetra::distributed {
namespace {

/// Returns the sharing of the remaining vertices: every sharer of a vertex keeps it, so the sharers
/// do not change.
Sharing<VertexIndex> sharing_after(const Sharing<VertexIndex>& sharing, const KeptVertices& kept,
                                   const CoarserPart& part, const CanonicalNumbers& numbers,
                                   const CoarserNumbers& numbers_after) {
    Sharing<VertexIndex> after;
    SharingBuilder<VertexIndex> builder(after, sharing.rank());
    for (const SharedWith<VertexIndex>& with : sharing.neighbours()) {
        std::vector<VertexIndex> vertices;
        for (const VertexIndex v : with.entities) {
            if (kept[v] != 0) vertices.push_back(part.vertex_after[v]);
        }
        builder.share(with.rank, std::move(vertices));
    }
    builder.prepare([&](VertexIndex v) {
        const std::size_t first = numbers_after.first.value();
        return static_cast<std::uint64_t>(
            v.value() < first ? numbers.of_vertex[v] : numbers_after.from_first[v.value() - first]);
    });
    builder.commit();
    return after;
}

/// Coarsens the lists of a process's own part, incrementally or by rebuilding them.
struct Lists {
    std::unique_ptr<IncrementalCoarsening> incremental;
    std::unique_ptr<CanonicalOrder> order;  ///< of the mesh, if lists are rebuilt

    /// Returns the marked cells by their canonical numbers.
    [[nodiscard]] MarkedCells make_canonical(DistributedMesh& mesh, MarkedCells marked) {
        order = std::make_unique<CanonicalOrder>(mesh);
        return renumbered(std::move(marked), order->cells_before());
    }
    void plan(DistributedMesh& mesh, const KeptVertices& kept, const Tuning& tuning,
              CoarserPart& part) {
        if (mesh.adjacency && mesh.adjacency->has_index) {
            incremental = IncrementalCoarsening::of(mesh, kept, tuning);
        }
        if (incremental) {
            incremental->plan(kept, part);
        } else {
            if (order == nullptr) order = std::make_unique<CanonicalOrder>(mesh);
            coarsen_lists(mesh, *order, kept, part);
        }
    }
    void commit(DistributedMesh& mesh, CoarserPart& part) noexcept {
        if (incremental) {
            incremental->commit(part);
        } else {
            order->keep();
            commit_new_lists(mesh, part);
        }
    }
};

/// The changes of coarsening, ready to be committed.
struct Coarsening {
    CoarserPart part;
    Lists lists;
    CoarserNumbers numbers;
    Sharing<VertexIndex> sharing;
    Adaptation adaptation;
};

/// Collective. Plans coarsening; returns nothing on all processes if no vertex is removed.
std::optional<Coarsening> plan_coarsening(AdaptiveMesh::State& state,
                                          const std::function<MarkedCells()>& mark,
                                          const Tuning& tuning) {
    DistributedMesh& mesh = state.mesh;
    const Communicator& processes = mesh.processes;
    MarkedCells marked = mark();
    Coarsening coarsening;
    // Families are found in canonical order.
    const bool is_regular = mesh.closure == Closure::regular;
    if (is_regular) marked = coarsening.lists.make_canonical(mesh, std::move(marked));
    const bool is_incremental = !is_regular && suits_incremental_level(mesh, marked, tuning);
    Adjacency* const adjacency = is_incremental ? &Adjacency::of(mesh) : nullptr;
    const KeptVertices kept = find_kept_vertices(mesh, state.sharing, marked, adjacency);
    const auto removed_count = static_cast<std::uint64_t>(std::ranges::count(kept, 0));
    if (processes.max(removed_count) == 0) return std::nullopt;

    CoarserPart& part = coarsening.part;
    Adaptation& adaptation = coarsening.adaptation;
    part = coarser_vertices(mesh, kept);
    coarsening.lists.plan(mesh, kept, tuning, part);
    adaptation.removed_vertices =
        removed_vertices(mesh, kept, part, coarsening.lists.incremental != nullptr);
    drop_empty_levels(mesh, part);
    coarsening.numbers = coarser_numbers(processes, state.numbers, state.sharing, kept, part);
    coarsening.sharing =
        sharing_after(state.sharing, kept, part, state.numbers, coarsening.numbers);
    adaptation.changed = true;
    adaptation.cells = std::move(part.cells);
    adaptation.facets = std::move(part.facets);
    adaptation.edges = std::move(part.edges);
    adaptation.vertex_count_before = mesh.points.size();
    return coarsening;
}

}  // namespace

Adaptation coarsen_state(AdaptiveMesh::State& state, const std::function<MarkedCells()>& mark,
                         const Tuning& tuning) {
    const StandardArithmetic standard;
    DistributedMesh& mesh = state.mesh;
    const Phase phase(mesh.processes, "coarsen");
    std::optional<Coarsening> planned =
        mesh.processes.transaction([&] { return plan_coarsening(state, mark, tuning); });
    if (!planned) return unchanged(mesh);

    auto& [part, lists, numbers, sharing, adaptation] = *planned;
    const std::size_t levels_before = mesh.level_begin.size();
    lists.commit(mesh, part);
    commit_vertices(mesh, part);
    commit_numbers(numbers, part, state.numbers);
    adaptation.vertices_before = std::move(part.vertices_before);
    state.sharing = std::move(sharing);
    state.transition_kinds.clear();
    state.step_count -= static_cast<int>(levels_before - mesh.level_begin.size());
    return std::move(adaptation);
}

}  // namespace octetra::distributed
