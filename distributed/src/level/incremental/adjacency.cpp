#include "level/incremental/adjacency.hpp"

#include <algorithm>

#include "level/huge_pages.hpp"

namespace octetra::distributed {

Adjacency::Adjacency(DistributedMesh& mesh)
    : cells(mesh.points.size(), mesh.cells),
      facets(mesh.points.size(), mesh.facets),
      edges(mesh.points.size(), mesh.edges),
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
    // A cell has 4 places at vertices, and may become 8 cells; others have and become less.
    constexpr std::size_t most = CellIndex::limit / (4 * 8);
    std::size_t shared = 0;
    for (const Interface& interface : mesh.interfaces) {
        shared += interface.edges.size() + interface.faces.size();
    }
    return std::max({mesh.cells.size(), mesh.facets.size(), mesh.edges.size(), shared}) <= most;
}

void Adjacency::add_vertices(std::size_t count) {
    cells.add_vertices(count);
    facets.add_vertices(count);
    edges.add_vertices(count);
    shared_edges.add_vertices(count);
    shared_faces.add_vertices(count);
}

void DeleteAdjacency::operator()(Adjacency* adjacency) const { delete adjacency; }

void restore_canonical_order(DistributedMesh& mesh) {
    if (mesh.adjacency == nullptr) return;
    Adjacency& adjacency = *mesh.adjacency;
    std::move(adjacency.cells).restore_canonical_order(mesh.cells, mesh.cell_ancestors);
    std::move(adjacency.facets).restore_canonical_order(mesh.facets, mesh.facet_ancestors);
    std::move(adjacency.edges).restore_canonical_order(mesh.edges, mesh.edge_ancestors);
    mesh.adjacency.reset();
}

}  // namespace octetra::distributed
