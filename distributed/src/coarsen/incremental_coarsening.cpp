#include "coarsen/incremental_coarsening.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "coarsen/family_division.hpp"

namespace octetra::distributed {
namespace {

std::vector<VertexIndex> gone_of(const KeptVertices& kept) {
    std::vector<VertexIndex> gone;
    for (auto next = kept.begin();;) {
        next = std::find(next, kept.end(), 0);
        if (next == kept.end()) return gone;
        gone.push_back(VertexIndex{static_cast<std::size_t>(next++ - kept.begin())});
    }
}

/// Vertices older than the first that goes have their numbers still.
void renumber(auto& list, const CoarserPart& part) {
    for (auto& vertices : list) {
        for (VertexIndex& v : vertices) {
            if (v >= part.first_gone) v = part.vertex_after[v];
        }
    }
}

}  // namespace

IncrementalCoarsening::IncrementalCoarsening(DistributedMesh& mesh)
    : mesh_(&mesh),
      adjacency_(mesh.adjacency.get()),
      cells_(mesh.cells, adjacency_->cells, mesh.cell_ancestors),
      facets_(mesh.facets, adjacency_->facets, mesh.facet_ancestors),
      edges_(mesh.edges, adjacency_->edges, mesh.edge_ancestors) {}

std::unique_ptr<IncrementalCoarsening> IncrementalCoarsening::of(DistributedMesh& mesh,
                                                                 const KeptVertices& kept,
                                                                 const Tuning& tuning) {
    std::unique_ptr<IncrementalCoarsening> coarsening(new IncrementalCoarsening(mesh));
    const std::vector<VertexIndex> gone = gone_of(kept);
    const double most = tuning.roots_below * static_cast<double>(mesh.cells.size());
    if (!coarsening->cells_.find(gone, static_cast<std::size_t>(most))) return nullptr;
    // Those are as many as their cells' faces and edges at most.
    (void)coarsening->facets_.find(gone, mesh.facets.size());
    (void)coarsening->edges_.find(gone, mesh.edges.size());
    return coarsening;
}

void IncrementalCoarsening::plan(const KeptVertices& kept, CoarserPart& part) {
    const VertexLevels levels(*mesh_);
    FamilyDivision divide(*mesh_, levels.count());
    cells_.plan(levels, kept, divide);
    facets_.plan(levels, kept, divide);
    edges_.plan(levels, kept, divide);
    part.failures = std::move(divide).failures();
    cells_.for_each_changed(
        [&](CellIndex c) { changed_blocks_.push_back(c.value() / CellBlocks::size); });
    std::ranges::sort(changed_blocks_);
    changed_blocks_.erase(std::unique(changed_blocks_.begin(), changed_blocks_.end()),
                          changed_blocks_.end());
    part.cells = cells_.succession();
    part.facets = facets_.succession();
    part.edges = edges_.succession();
    const std::size_t vertex_count = part.mesh.points.size();
    shared_edges_ = SharedEntities<2>(vertex_count, part.mesh.interfaces);
    shared_faces_ = SharedEntities<3>(vertex_count, part.mesh.interfaces);
}

void IncrementalCoarsening::commit(CoarserPart& part) noexcept {
    DistributedMesh& mesh = *mesh_;
    cells_.commit(mesh.cells, adjacency_->cells, mesh.cell_ancestors);
    facets_.commit(mesh.facets, adjacency_->facets, mesh.facet_ancestors);
    edges_.commit(mesh.edges, adjacency_->edges, mesh.edge_ancestors);
    adjacency_->blocks.truncate(mesh.cells.size());
    for (const std::size_t block : changed_blocks_) adjacency_->blocks.renew(mesh, block);
    adjacency_->new_cells.clear();
    adjacency_->cell_to_note.resize(mesh.cells.size());

    renumber(mesh.cells, part);
    renumber(mesh.facets, part);
    renumber(mesh.edges, part);
    const auto& before = part.vertices_before;
    adjacency_->cells.keep_vertices(before);
    adjacency_->facets.keep_vertices(before);
    adjacency_->edges.keep_vertices(before);
    adjacency_->shared_edges = std::move(shared_edges_);
    adjacency_->shared_faces = std::move(shared_faces_);

    part.mesh.cells = std::move(mesh.cells);
    part.mesh.facets = std::move(mesh.facets);
    part.mesh.edges = std::move(mesh.edges);
    part.mesh.cell_ancestors = std::move(mesh.cell_ancestors);
    part.mesh.facet_ancestors = std::move(mesh.facet_ancestors);
    part.mesh.edge_ancestors = std::move(mesh.edge_ancestors);
    part.mesh.adjacency = std::move(mesh.adjacency);
}

}  // namespace octetra::distributed
