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
#include "comm/local_failure.hpp"
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

void describe(std::size_t vertex_count_before, CoarserPart& part, Adaptation& adaptation) {
    adaptation.changed = true;
    adaptation.cells = std::move(part.cells);
    adaptation.facets = std::move(part.facets);
    adaptation.edges = std::move(part.edges);
    adaptation.vertex_count_before = vertex_count_before;
}

/// Coarsens the lists of a process's own part, incrementally or by rebuilding them.
struct Lists {
    std::unique_ptr<IncrementalCoarsening> incremental;
    std::unique_ptr<CanonicalOrder> order;  ///< of the mesh, if lists are rebuilt

    void plan(DistributedMesh& mesh, const KeptVertices& kept, const Tuning& tuning,
              CoarserPart& part) {
        if (mesh.adjacency && mesh.adjacency->has_index) {
            incremental = IncrementalCoarsening::of(mesh, kept, tuning);
        }
        if (incremental) {
            incremental->plan(kept, part);
        } else {
            order = std::make_unique<CanonicalOrder>(mesh);
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

}  // namespace

Adaptation coarsen_state(AdaptiveMesh::State& state, const std::function<MarkedCells()>& mark,
                         const Tuning& tuning) {
    const StandardArithmetic standard;
    DistributedMesh& mesh = state.mesh;
    const Communicator& processes = mesh.processes;
    const Phase phase(processes, "coarsen");
    LocalFailure failure;
    MarkedCells marked;
    Adjacency* adjacency = nullptr;
    failure.attempt([&] {
        marked = mark();
        if (suits_incremental_level(mesh, marked, tuning)) adjacency = &Adjacency::of(mesh);
    });
    const KeptVertices kept = find_kept_vertices(mesh, state.sharing, marked, adjacency, failure);
    const auto removed_count = static_cast<std::uint64_t>(std::ranges::count(kept, 0));
    const std::uint64_t most = failure.max_unless_failed(processes, removed_count);
    if (most == LocalFailure::somewhere) failure.agree(processes);
    Adaptation adaptation;
    if (most == 0) {
        failure.attempt([&] { adaptation = unchanged(mesh); });
        failure.agree(processes);
        return adaptation;
    }

    std::optional<CoarserPart> part;
    Lists lists;
    failure.attempt([&] {
        part = coarser_vertices(mesh, kept);
        lists.plan(mesh, kept, tuning, *part);
        adaptation.removed_vertices =
            removed_vertices(mesh, kept, *part, lists.incremental != nullptr);
    });
    failure.agree(processes);
    drop_empty_levels(mesh, *part);
    const CoarserNumbers numbers =
        coarser_numbers(processes, state.numbers, state.sharing, kept, *part, failure);
    failure.agree(processes);
    std::optional<Sharing<VertexIndex>> sharing;
    failure.attempt(
        [&] { sharing = sharing_after(state.sharing, kept, *part, state.numbers, numbers); });
    failure.agree(processes);

    const std::size_t levels_before = mesh.level_begin.size();
    describe(mesh.points.size(), *part, adaptation);
    lists.commit(mesh, *part);
    commit_vertices(mesh, *part);
    commit_numbers(numbers, *part, state.numbers);
    adaptation.vertices_before = std::move(part->vertices_before);
    state.sharing = *std::move(sharing);
    state.step_count -= static_cast<int>(levels_before - mesh.level_begin.size());
    return adaptation;
}

}  // namespace octetra::distributed
