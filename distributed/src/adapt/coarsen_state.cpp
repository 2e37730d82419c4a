#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <octetra/distributed/profile.hpp>

#include "adapt/mesh_state.hpp"
#include "coarsen/coarser_part.hpp"
#include "coarsen/kept_vertices.hpp"
#include "comm/local_failure.hpp"
#include "level/incremental/adjacency.hpp"
#include "sharing/sharing_builder.hpp"

namespace octetra::distributed {
namespace {

/// A byte for each cell as it stands in canonical order.
std::vector<std::uint8_t> in_order(const MarkedCells& marked, std::size_t cell_count,
                                   const std::vector<CellIndex>& before) {
    std::vector<std::uint8_t> marks(cell_count, marked.all ? 1 : 0);
    for (const CellIndex c : marked.cells) marks[c.value()] = 1;
    if (before.empty()) return marks;
    std::vector<std::uint8_t> ordered;
    ordered.reserve(marks.size());
    for (const CellIndex c : before) ordered.push_back(marks[c.value()]);
    return ordered;
}

/// What is known of entities in canonical order, by the numbers that they had.
template <class T, class I>
std::vector<T> by_number(std::vector<T> ordered, const std::vector<I>& before) {
    if (before.empty()) return ordered;
    std::vector<T> values(ordered.size());
    for (std::size_t k = 0; k < before.size(); ++k) values[before[k].value()] = ordered[k];
    return values;
}

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
    const auto& before = part.vertices_before;
    std::size_t first_gone = 0;
    while (first_gone < before.size() && before[first_gone].value() == first_gone) ++first_gone;
    const auto level = std::ranges::upper_bound(mesh.level_begin, VertexIndex{first_gone}) -
                       mesh.level_begin.begin();              // all of them where none goes
    const std::size_t level_count = mesh.level_begin.size();  // the same on all processes
    const std::size_t changed = level_count + 1 - static_cast<std::size_t>(level);
    const bool loses_any = first_gone < mesh.points.size();
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

Adaptation adaptation_of(const DistributedMesh& mesh, const CanonicalOrder& order, CoarserPart part,
                         const DistributedMesh& after) {
    Adaptation adaptation;
    adaptation.changed = true;
    adaptation.cells = Succession::of_merges(
        after.cells.size(), by_number(std::move(part.cell_after), order.cells_before()),
        by_number(std::move(part.halvings), order.cells_before()));
    adaptation.facets = Succession::of_merges(
        after.facets.size(), by_number(std::move(part.facet_after), order.facets_before()), {});
    adaptation.edges = Succession::of_merges(
        after.edges.size(), by_number(std::move(part.edge_after), order.edges_before()), {});
    adaptation.vertex_count_before = mesh.points.size();
    adaptation.vertices_before = std::move(part.vertices_before);
    return adaptation;
}

}  // namespace

Adaptation coarsen_state(std::unique_ptr<AdaptiveMesh::State>& state,
                         const std::function<MarkedCells()>& mark) {
    DistributedMesh& mesh = state->mesh;
    const Communicator processes = mesh.processes;
    const Phase phase(processes, "coarsen");
    LocalFailure failure;
    std::unique_ptr<CanonicalOrder> order;
    std::vector<std::uint8_t> may_go;
    failure.attempt([&] {
        const MarkedCells marked = mark();
        order = std::make_unique<CanonicalOrder>(mesh);
        may_go = in_order(marked, mesh.cells.size(), order->cells_before());
    });
    const KeptVertices kept = find_kept_vertices(mesh, state->sharing, may_go, failure);
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
    failure.attempt([&] { part = coarser_part(mesh, kept); });
    failure.agree(processes);
    drop_empty_levels(*part);
    CanonicalNumbers numbers = numbers_after(*state, *part, failure);
    std::unique_ptr<AdaptiveMesh::State> next;
    failure.attempt([&] {
        auto sharing = sharing_after(state->sharing, *part, numbers);
        next = std::make_unique<AdaptiveMesh::State>(std::move(part->mesh), std::move(numbers),
                                                     std::move(sharing));
        adaptation = adaptation_of(mesh, *order, *std::move(part), next->mesh);
    });
    failure.agree(processes);
    order.reset();
    state = std::move(next);
    return adaptation;
}

}  // namespace octetra::distributed
