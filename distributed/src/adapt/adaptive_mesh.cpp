#include <octetra/distributed/adaptive_mesh.hpp>

#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/distributed/read_parts.hpp>

#include "adapt/marked_cells.hpp"
#include "adapt/marks.hpp"
#include "adapt/mesh_state.hpp"
#include "numbering/cell_numbers.hpp"
#include "topology/face_neighbours.hpp"
#include "topology/find_ghosts.hpp"
#include "topology/number_sides.hpp"
#include "topology/orient_facets.hpp"

namespace octetra::distributed {

namespace {

/// Calls visit(number, root) for each entity of a list.
template <class I>
void for_each_root(const AncestorMap& ancestors, const auto* unordered, std::size_t count,
                   auto&& visit) {
    if (unordered != nullptr) {
        for (I i{0}; i < I{count}; ++i) visit(i.value(), unordered->root_of(i));
        return;
    }
    for (std::uint32_t r = 0; r < ancestors.roots.size(); ++r) {
        for (std::uint32_t i = ancestors.first[r]; i < ancestors.first[r + 1]; ++i) visit(i, r);
    }
}

/// Returns the marker of each entity of a list.
template <class I>
std::vector<Marker> all_markers(const AncestorMap& ancestors, const auto* unordered,
                                std::size_t count) {
    std::vector<Marker> markers;
    if (ancestors.markers.empty()) return markers;
    markers.resize(count);
    for_each_root<I>(ancestors, unordered, count,
                     [&](std::uint32_t i, std::uint32_t r) { markers[i] = ancestors.markers[r]; });
    return markers;
}

}  // namespace

AdaptiveMesh::AdaptiveMesh(std::unique_ptr<State> state) : state_(std::move(state)) {}
AdaptiveMesh::AdaptiveMesh(DistributedMesh part) : state_(State::make(std::move(part))) {}
AdaptiveMesh::~AdaptiveMesh() = default;
AdaptiveMesh::AdaptiveMesh(AdaptiveMesh&&) noexcept = default;
AdaptiveMesh& AdaptiveMesh::operator=(AdaptiveMesh&&) noexcept = default;

AdaptiveMesh AdaptiveMesh::read(const Communicator& processes, const std::filesystem::path& path,
                                const Partition& partition) {
    return AdaptiveMesh(read_parts(processes, path, partition));
}

AdaptiveMesh AdaptiveMesh::distribute(const Communicator& processes, Mesh mesh,
                                      const std::vector<int>& cell_to_rank) {
    return AdaptiveMesh(distributed::distribute(processes, std::move(mesh), cell_to_rank));
}

AdaptiveMesh AdaptiveMesh::from_parts(const Communicator& processes, MeshPart part) {
    return AdaptiveMesh(distribute_parts(processes, std::move(part)));
}

Adaptation AdaptiveMesh::refine(std::span<const std::uint8_t> marks, const StepOptions& options) {
    return refine([&] { return StepRequest{marks, options}; });
}

Adaptation AdaptiveMesh::refine(const std::function<StepRequest()>& request) {
    StepRequest wanted;
    // If all cells are marked on all processes, no closure is needed.
    const bool are_all = processes().transaction([&] {
        wanted = request();
        const bool are_all_here = wanted.marks.size() == cells().size() &&
                                  std::ranges::find(wanted.marks, 0) == wanted.marks.end();
        return processes().max(are_all_here ? 0 : 1) == 0;
    });
    if (are_all) return refine(Selection{.all = true}, wanted.options);
    return state_->refine([&] { return marked_by_bytes(state_->mesh, wanted.marks); },
                          wanted.options);
}

Adaptation AdaptiveMesh::refine(std::span<const CellIndex> marked, const StepOptions& options) {
    return state_->refine([&] { return marked_by_list(state_->mesh, marked); }, options);
}

Adaptation AdaptiveMesh::refine(const Selection& selection, const StepOptions& options) {
    return state_->refine(marks_of(*state_, selection), options);
}

Adaptation AdaptiveMesh::refine_edges(std::span<const EdgeVertices> marked,
                                      const StepOptions& options) {
    return state_->refine([&] { return cells_with_marked_edges(state_->mesh, marked); }, options);
}

EvenStep AdaptiveMesh::refine_evenly(std::span<const std::uint8_t> marks,
                                     const BalanceOptions& balance, const StepOptions& options) {
    return refine_state_evenly(
        *state_, [&] { return marked_by_bytes(state_->mesh, marks); }, balance, options);
}

EvenStep AdaptiveMesh::refine_evenly(const Selection& selection, const BalanceOptions& balance,
                                     const StepOptions& options) {
    return refine_state_evenly(*state_, marks_of(*state_, selection), balance, options);
}

Adaptation AdaptiveMesh::coarsen(std::span<const std::uint8_t> may_coarsen) {
    return coarsen_state(*state_, [&] { return marked_by_bytes(state_->mesh, may_coarsen); });
}

Adaptation AdaptiveMesh::coarsen(std::span<const CellIndex> may_coarsen) {
    return coarsen_state(*state_, [&] { return marked_by_list(state_->mesh, may_coarsen); });
}

Adaptation AdaptiveMesh::coarsen(const Selection& may_coarsen) {
    return coarsen_state(*state_, marks_of(*state_, may_coarsen));
}

Migration AdaptiveMesh::rebalance(const BalanceOptions& options) {
    return rebalance_state(*state_, options);
}
bool AdaptiveMesh::has_forgotten_history() const { return !state_->forgotten.empty(); }
Migration AdaptiveMesh::recall_history() { return distributed::recall_history(*state_); }
Migration AdaptiveMesh::migrate(std::span<const int> rank_of_root) {
    return migrate_state(*state_, rank_of_root);
}

std::span<const std::uint64_t> AdaptiveMesh::roots() const {
    return state_->mesh.cell_ancestors.roots;
}
std::vector<std::uint32_t> AdaptiveMesh::root_of_cells() const {
    const DistributedMesh& mesh = state_->mesh;
    std::vector<std::uint32_t> roots(mesh.cells.size());
    for_each_root<CellIndex>(mesh.cell_ancestors, mesh.adjacency ? &mesh.adjacency->cells : nullptr,
                             mesh.cells.size(),
                             [&](std::uint32_t c, std::uint32_t r) { roots[c] = r; });
    return roots;
}

const Communicator& AdaptiveMesh::processes() const { return state_->mesh.processes; }
std::span<const Point> AdaptiveMesh::points() const { return state_->mesh.points; }
std::span<const CellVertices> AdaptiveMesh::cells() const { return state_->mesh.cells; }
std::span<const FacetVertices> AdaptiveMesh::facets() const { return state_->mesh.facets; }
std::span<const EdgeVertices> AdaptiveMesh::edges() const { return state_->mesh.edges; }

std::vector<Marker> AdaptiveMesh::regions() const {
    const DistributedMesh& mesh = state_->mesh;
    return all_markers<CellIndex>(
        mesh.cell_ancestors, mesh.adjacency ? &mesh.adjacency->cells : nullptr, mesh.cells.size());
}
std::vector<Marker> AdaptiveMesh::facet_markers() const {
    const DistributedMesh& mesh = state_->mesh;
    return all_markers<FacetIndex>(mesh.facet_ancestors,
                                   mesh.adjacency ? &mesh.adjacency->facets : nullptr,
                                   mesh.facets.size());
}
std::vector<Marker> AdaptiveMesh::edge_markers() const {
    const DistributedMesh& mesh = state_->mesh;
    return all_markers<EdgeIndex>(
        mesh.edge_ancestors, mesh.adjacency ? &mesh.adjacency->edges : nullptr, mesh.edges.size());
}

std::vector<FacetVertices> AdaptiveMesh::oriented_facets() const {
    return orient_facets(state_->mesh);
}
std::span<const double> AdaptiveMesh::vertex_attributes() const {
    return state_->mesh.point_attributes;
}
std::size_t AdaptiveMesh::attributes_per_vertex() const {
    return state_->mesh.attributes_per_point;
}
std::vector<std::uint64_t> AdaptiveMesh::cell_numbers() const {
    return processes().transaction([&] { return distributed::cell_numbers(state_->mesh); });
}
IndexMap<CellIndex> AdaptiveMesh::cell_index_map() const {
    return processes().transaction(
        [&] { return make_index_map(processes(), Sharing<CellIndex>(), cells().size()); });
}

std::uint32_t AdaptiveMesh::index_base() const { return state_->mesh.index_base; }
std::uint64_t AdaptiveMesh::vertex_count() const { return state_->numbers.vertex_count; }
std::span<const GlobalVertex> AdaptiveMesh::vertex_numbers() const {
    return state_->numbers.of_vertex;
}
const std::vector<GroupName>& AdaptiveMesh::group_names() const {
    return state_->mesh.group_names.list();
}
const Sharing<VertexIndex>& AdaptiveMesh::vertex_sharing() const { return state_->sharing; }

std::vector<BoundaryFace> AdaptiveMesh::boundary() const { return find_boundary(state_->mesh); }
FaceNeighbours AdaptiveMesh::face_neighbours() const {
    return processes().transaction([&] { return find_face_neighbours(state_->mesh); });
}
MeshEdges AdaptiveMesh::number_edges() const {
    return processes().transaction([&] {
        return distributed::number_edges(state_->mesh, state_->numbers, state_->sharing.shared());
    });
}
MeshFaces AdaptiveMesh::number_faces() const {
    return processes().transaction([&] {
        return distributed::number_faces(state_->mesh, state_->numbers, state_->sharing.shared());
    });
}
GhostLayer AdaptiveMesh::ghosts(GhostsBy by) const {
    return processes().transaction(
        [&] { return find_ghosts(state_->mesh, state_->numbers, state_->sharing, regions(), by); });
}

Mesh AdaptiveMesh::collect() const {
    return processes().transaction([&] { return collect_copy(state_->mesh).mesh; });
}
CanonicalMesh AdaptiveMesh::canonical() const { return CanonicalMesh::of(state_->mesh); }

}  // namespace octetra::distributed
