#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <octetra/distributed/profile.hpp>

#include "adapt/mesh_state.hpp"
#include "coarsen/coarser_part.hpp"
#include "coarsen/incremental_coarsening.hpp"
#include "coarsen/kept_vertices.hpp"
#include "comm/local_failure.hpp"
#include "level/incremental/adjacency.hpp"
#include "level/incremental/suits_incremental_level.hpp"
#include "sharing/sharing_builder.hpp"

namespace octetra::distributed {
namespace {

/// The shared vertices that stay, by the numbers that they have then.
std::vector<VertexIndex> kept_of(const std::vector<VertexIndex>& shared,
                                 const std::vector<VertexIndex>& vertices_before) {
    std::vector<VertexIndex> kept;
    for (const VertexIndex v : shared) {
        const auto found = std::ranges::lower_bound(vertices_before, v);
        if (found == vertices_before.end() || *found != v) continue;
        kept.push_back(VertexIndex{static_cast<std::size_t>(found - vertices_before.begin())});
    }
    return kept;
}

/// Collective. The first level, from 0, that loses a vertex on any process.
std::size_t first_changed_level(const DistributedMesh& mesh, const CoarserPart& part) {
    const auto level = std::ranges::upper_bound(mesh.level_begin, part.first_gone) -
                       mesh.level_begin.begin();              // all of them where none goes
    const std::size_t level_count = mesh.level_begin.size();  // the same on all processes
    const std::size_t changed = level_count + 1 - static_cast<std::size_t>(level);
    const bool loses_any = part.first_gone < mesh.points.end_index();
    return level_count - mesh.processes.max(loses_any ? changed : 0);
}

/// Collective. The numbers of the vertices that stay: before the first level that loses any, they
/// are as they were.
CanonicalNumbers numbers_after(const AdaptiveMesh::State& state, const CoarserPart& part,
                               LocalFailure& failure) {
    const DistributedMesh& after = part.mesh;
    const std::size_t first_level = first_changed_level(state.mesh, part);
    CanonicalNumbers numbers;
    std::vector<VertexIndex> shared;
    std::uint64_t same = 0;
    failure.attempt([&] {
        const auto& before = state.numbers.of_vertex;
        const auto count = static_cast<std::ptrdiff_t>(state.mesh.level_begin[first_level].value());
        numbers.of_vertex.reserve(after.points.size());
        numbers.of_vertex.assign(before.begin(), before.begin() + count);
        shared = kept_of(state.sharing.shared(), part.vertices_before);
        if (count > 0) same = static_cast<std::uint64_t>(numbers.of_vertex.back()) + 1;
    });
    numbers.vertex_count = after.processes.max(std::max(same, state.mesh.input_vertex_count));
    for (std::size_t t = first_level; t < after.level_begin.size(); ++t) {
        const VertexIndex end =
            t + 1 < after.level_begin.size() ? after.level_begin[t + 1] : after.points.end_index();
        if (!numbers.number_midpoints(after, end, shared, failure)) break;
    }
    return numbers;
}

/// Who shares the vertices that stay. Whoever has one keeps it, so they are those of before.
Sharing<VertexIndex> sharing_after(const Sharing<VertexIndex>& sharing, const CoarserPart& part,
                                   const CanonicalNumbers& numbers) {
    Sharing<VertexIndex> after;
    SharingBuilder<VertexIndex> builder(after, sharing.rank());
    for (const SharedWith<VertexIndex>& with : sharing.neighbours()) {
        builder.share(with.rank, kept_of(with.entities, part.vertices_before));
    }
    builder.prepare(
        [&](VertexIndex v) { return static_cast<std::uint64_t>(numbers.of_vertex[v]); });
    builder.commit();
    return after;
}

Adaptation adaptation_of(std::size_t vertex_count_before, CoarserPart& part) {
    Adaptation adaptation;
    adaptation.changed = true;
    adaptation.cells = std::move(part.cells);
    adaptation.facets = std::move(part.facets);
    adaptation.edges = std::move(part.edges);
    adaptation.vertex_count_before = vertex_count_before;
    return adaptation;
}

/// What a process does with the lists of its own part, in one of two ways.
struct Lists {
    std::unique_ptr<IncrementalCoarsening> incremental;
    std::unique_ptr<CanonicalOrder> order;  ///< for the other one

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
    void commit(CoarserPart& part) noexcept {
        if (incremental) incremental->commit(part);
        order.reset();
    }
};

}  // namespace

Adaptation coarsen_state(AdaptiveMesh::State& state, const std::function<MarkedCells()>& mark,
                         const Tuning& tuning) {
    DistributedMesh& mesh = state.mesh;
    const Communicator& processes = mesh.processes;
    const Phase phase(processes, "coarsen");
    LocalFailure failure;
    MarkedCells marked;
    const Adjacency* adjacency = nullptr;
    failure.attempt([&] {
        marked = mark();
        if (suits_incremental_level(mesh, marked, tuning)) adjacency = &Adjacency::of(mesh);
    });
    const KeptVertices kept = find_kept_vertices(mesh, state.sharing, marked, adjacency, failure);
    const auto gone = static_cast<std::uint64_t>(std::ranges::count(kept, 0));
    const std::uint64_t most = failure.max_unless_failed(processes, gone);
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
    });
    failure.agree(processes);
    drop_empty_levels(*part);
    CanonicalNumbers numbers = numbers_after(state, *part, failure);
    std::optional<Sharing<VertexIndex>> sharing;
    failure.attempt([&] { sharing = sharing_after(state.sharing, *part, numbers); });
    failure.agree(processes);

    adaptation = adaptation_of(mesh.points.size(), *part);
    lists.commit(*part);
    adaptation.vertices_before = std::move(part->vertices_before);
    state.mesh = std::move(part->mesh);
    state.numbers = std::move(numbers);
    state.sharing = *std::move(sharing);
    state.step_count = static_cast<int>(mesh.level_begin.size());
    return adaptation;
}

}  // namespace octetra::distributed
