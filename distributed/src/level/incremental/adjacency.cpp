#include "level/incremental/adjacency.hpp"

#include <algorithm>

#include <octetra/core/huge_pages.hpp>
#include <octetra/distributed/profile.hpp>

namespace octetra::distributed {

Adjacency::Adjacency(DistributedMesh& mesh)
    : cells(mesh.points.size(), mesh.cells, mesh.cell_ancestors),
      facets(mesh.points.size(), mesh.facets, mesh.facet_ancestors),
      edges(mesh.points.size(), mesh.edges, mesh.edge_ancestors),
      shared_edges(mesh.points.size(), mesh.interfaces),
      shared_faces(mesh.points.size(), mesh.interfaces),
      blocks(mesh) {
    reserve_with_room(cell_to_note, mesh.cells.size());
    cell_to_note.assign(mesh.cells.size(), CellIndex::none_value);
    reserve_with_room(mesh.cells, mesh.cells.size());
    reserve_with_room(mesh.points, mesh.points.size());
    reserve_with_room(mesh.midpoint_to_edge, mesh.midpoint_to_edge.size());
}

bool Adjacency::can_hold(const DistributedMesh& mesh) {
    // A cell has 4 links and may become 8 cells; other entities have and become fewer.
    constexpr std::size_t most = CellIndex::limit / (4 * 8);
    std::size_t shared = 0;
    for (const Interface& interface : mesh.interfaces) {
        shared += interface.edges.size() + interface.faces.size();
    }
    return std::max({mesh.cells.size(), mesh.facets.size(), mesh.edges.size(), shared}) <= most;
}

void Adjacency::set_vertex_count(std::size_t count) {
    cells.set_vertex_count(count);
    facets.set_vertex_count(count);
    edges.set_vertex_count(count);
    shared_edges.set_vertex_count(count);
    shared_faces.set_vertex_count(count);
}

Adjacency& Adjacency::of(DistributedMesh& mesh) {
    const Phase phase(mesh.processes, "adjacency");
    if (mesh.adjacency == nullptr) {
        mesh.adjacency.reset(new Adjacency(mesh));
    } else {
        mesh.adjacency->make_index(mesh);
    }
    return *mesh.adjacency;
}

void DeleteAdjacency::operator()(Adjacency* adjacency) const { delete adjacency; }

void Adjacency::drop_index() noexcept {
    cells.drop_index();
    facets.drop_index();
    edges.drop_index();
    shared_edges = {};
    shared_faces = {};
    has_index = false;
}

void Adjacency::make_index(const DistributedMesh& mesh) {
    if (has_index) return;
    const std::size_t vertex_count = mesh.points.size();
    cells.make_index(vertex_count, mesh.cells);
    facets.make_index(vertex_count, mesh.facets);
    edges.make_index(vertex_count, mesh.edges);
    shared_edges = SharedEntities<2>(vertex_count, mesh.interfaces);
    shared_faces = SharedEntities<3>(vertex_count, mesh.interfaces);
    has_index = true;
}

namespace {

template <class Unordered, class List>
typename Unordered::Ordered ordered(const Unordered& unordered, const List& list,
                                    const AncestorMap& ancestors) {
    if (unordered.is_ordered()) return {};
    return unordered.ordered(list, ancestors);
}

/// Does nothing if the list is in canonical order already.
template <class Ordered>
void swap_list(Ordered& other, auto& list, AncestorMap& ancestors) noexcept {
    if (other.before.empty()) return;
    list.swap(other.list);
    ancestors.first.swap(other.first);
}

}  // namespace

CanonicalOrder::CanonicalOrder(DistributedMesh& mesh) : mesh_(&mesh) {
    if (mesh.adjacency == nullptr) return;
    mesh.adjacency->drop_index();  // frees memory before the lists are copied
    cells_ = ordered(mesh.adjacency->cells, mesh.cells, mesh.cell_ancestors);
    facets_ = ordered(mesh.adjacency->facets, mesh.facets, mesh.facet_ancestors);
    edges_ = ordered(mesh.adjacency->edges, mesh.edges, mesh.edge_ancestors);
    swap_lists();
    adjacency_ = std::move(mesh.adjacency);
}

CanonicalOrder::~CanonicalOrder() {
    if (adjacency_ == nullptr) return;
    swap_lists();
    mesh_->adjacency = std::move(adjacency_);
}

void CanonicalOrder::keep() noexcept {
    adjacency_.reset();
    cells_.list = {};
    facets_.list = {};
    edges_.list = {};
}

void CanonicalOrder::swap_lists() noexcept {
    swap_list(cells_, mesh_->cells, mesh_->cell_ancestors);
    swap_list(facets_, mesh_->facets, mesh_->facet_ancestors);
    swap_list(edges_, mesh_->edges, mesh_->edge_ancestors);
}

void restore_canonical_order(DistributedMesh& mesh) { CanonicalOrder(mesh).keep(); }

}  // namespace octetra::distributed
