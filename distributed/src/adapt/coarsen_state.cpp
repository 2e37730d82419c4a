#include <algorithm>
#include <utility>

#include "adapt/mesh_state.hpp"
#include "comm/local_failure.hpp"
#include "history/coarsen.hpp"
#include "history/whole_of.hpp"
#include "sharing/sharing_builder.hpp"

namespace octetra::distributed {
namespace {

/// Who shares the vertices of the input, by a mesh that was refined from it.
Sharing<VertexIndex> sharing_of_input(const DistributedMesh& mesh,
                                      const Sharing<VertexIndex>& sharing) {
    Sharing<VertexIndex> of_input;
    SharingBuilder<VertexIndex> builder(of_input, mesh.processes.rank());
    const VertexIndex end{mesh.input_vertices.size()};
    for (const SharedWith<VertexIndex>& with : sharing.neighbours()) {
        std::vector<VertexIndex> vertices;
        std::ranges::copy_if(with.entities, std::back_inserter(vertices),
                             [&](VertexIndex v) { return v < end; });
        builder.share(with.rank, std::move(vertices));
    }
    builder.prepare(
        [&](VertexIndex v) { return static_cast<std::uint64_t>(mesh.input_vertices[v.value()]); });
    builder.commit();
    return of_input;
}

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

std::vector<std::uint32_t> values_of(const std::vector<CellIndex>& cells) {
    std::vector<std::uint32_t> values(cells.size());
    std::ranges::transform(cells, values.begin(), &CellIndex::value);
    return values;
}

/// `mesh` is in canonical order, which `order` has brought it into.
Adaptation adaptation_of(const DistributedMesh& mesh, const CanonicalOrder& order, Coarser coarser,
                         const DistributedMesh& after) {
    IndexVector<VertexIndex, VertexIndex> vertex_after(mesh.points.size(), VertexIndex::none());
    for (std::size_t v = 0; v < coarser.vertices_before.size(); ++v) {
        vertex_after[coarser.vertices_before[v]] = VertexIndex{v};
    }
    const auto facets = whole_of(mesh, mesh.facets, mesh.facet_ancestors, after.facets,
                                 after.facet_ancestors, vertex_after);
    const auto edges = whole_of(mesh, mesh.edges, mesh.edge_ancestors, after.edges,
                                after.edge_ancestors, vertex_after);
    Adaptation adaptation;
    adaptation.changed = true;
    adaptation.cells = Succession::of_merges(
        after.cells.size(), by_number(values_of(coarser.cell_after), order.cells_before()),
        by_number(std::move(coarser.halvings), order.cells_before()));
    adaptation.facets =
        Succession::of_merges(after.facets.size(), by_number(facets, order.facets_before()), {});
    adaptation.edges =
        Succession::of_merges(after.edges.size(), by_number(edges, order.edges_before()), {});
    adaptation.vertex_count_before = mesh.points.size();
    adaptation.vertices_before = std::move(coarser.vertices_before);
    return adaptation;
}

}  // namespace

Adaptation coarsen_state(std::unique_ptr<AdaptiveMesh::State>& state,
                         const std::function<MarkedCells()>& mark) {
    DistributedMesh& mesh = state->mesh;
    const Communicator processes = mesh.processes;
    LocalFailure failure;
    std::unique_ptr<CanonicalOrder> order;
    std::vector<CutRuns> steps;
    std::vector<std::uint8_t> may_go;
    failure.attempt([&] {
        const MarkedCells marked = mark();
        order = std::make_unique<CanonicalOrder>(mesh);
        steps = state->history.steps(order->cells_before());
        may_go = in_order(marked, mesh.cells.size(), order->cells_before());
    });
    Coarser coarser = coarsen(mesh, steps, may_go, failure);
    const std::size_t gone = mesh.points.size() - coarser.vertices_before.size();
    const std::uint64_t most = failure.max_unless_failed(processes, gone);
    if (most == LocalFailure::somewhere) failure.agree(processes);
    Adaptation adaptation;
    if (most == 0) {
        failure.attempt([&] { adaptation = unchanged(mesh); });
        failure.agree(processes);
        return adaptation;
    }

    std::unique_ptr<AdaptiveMesh::State> next;
    failure.attempt([&] {
        next = std::make_unique<AdaptiveMesh::State>(state->history.input_of(mesh),
                                                     sharing_of_input(mesh, state->sharing),
                                                     std::move(coarser.steps));
    });
    failure.agree(processes);
    next->replay();
    failure.attempt(
        [&] { adaptation = adaptation_of(mesh, *order, std::move(coarser), next->mesh); });
    failure.agree(processes);
    order.reset();
    state = std::move(next);
    return adaptation;
}

}  // namespace octetra::distributed
