#include "coarsen/incremental_coarsening.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "coarsen/family_division.hpp"
#include "coarsen/level_removals.hpp"

namespace octetra::distributed {
namespace {

std::vector<VertexIndex> removed_of(const KeptVertices& kept) {
    std::vector<VertexIndex> removed;
    for (std::size_t v = 0; v < kept.size(); ++v) {
        const void* const next = std::memchr(kept.data() + v, 0, kept.size() - v);
        if (next == nullptr) break;
        v = static_cast<std::size_t>(static_cast<const std::uint8_t*>(next) - kept.data());
        removed.push_back(VertexIndex{v});
    }
    return removed;
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
    const std::vector<VertexIndex> removed = removed_of(kept);
    const double most = tuning.roots_below * static_cast<double>(mesh.cells.size());
    if (!coarsening->cells_.find(removed, static_cast<std::size_t>(most))) return nullptr;
    // These are at most as many as the faces and edges of the cells found.
    (void)coarsening->facets_.find(removed, mesh.facets.size());
    (void)coarsening->edges_.find(removed, mesh.edges.size());
    return coarsening;
}

void IncrementalCoarsening::plan(const KeptVertices& kept, CoarserPart& part) {
    const VertexLevels levels(*mesh_);
    const LevelRemovals removals(levels, kept);
    FamilyDivision divide(*mesh_, levels.count());
    cells_.plan(levels, removals, kept, divide);
    facets_.plan(levels, removals, kept, divide);
    edges_.plan(levels, removals, kept, divide);
    part.failures = std::move(divide).failures();
    cells_.for_each_changed(
        [&](CellIndex c) { changed_blocks_.push_back(c.value() / CellBlocks::size); });
    std::ranges::sort(changed_blocks_);
    changed_blocks_.erase(std::unique(changed_blocks_.begin(), changed_blocks_.end()),
                          changed_blocks_.end());
    part.cells = cells_.entity_transfer();
    part.facets = facets_.entity_transfer();
    part.edges = edges_.entity_transfer();
    const std::size_t vertex_count = part.vertices_before.size();
    shared_edges_ = SharedEntities<2>(vertex_count, part.interfaces);
    shared_faces_ = SharedEntities<3>(vertex_count, part.interfaces);
}

void IncrementalCoarsening::commit(const CoarserPart& part) noexcept {
    DistributedMesh& mesh = *mesh_;
    cells_.commit(mesh.cells, adjacency_->cells, mesh.cell_ancestors);
    facets_.commit(mesh.facets, adjacency_->facets, mesh.facet_ancestors);
    edges_.commit(mesh.edges, adjacency_->edges, mesh.edge_ancestors);
    adjacency_->blocks.truncate(mesh.cells.size());
    for (const std::size_t block : changed_blocks_) adjacency_->blocks.renew(mesh, block);
    adjacency_->new_cells.clear();
    adjacency_->cell_to_note.resize(mesh.cells.size());

    const std::span<const VertexIndex> before = part.vertices_before;
    adjacency_->cells.keep_vertices(before, part.first_removed, mesh.cells);
    adjacency_->facets.keep_vertices(before, part.first_removed, mesh.facets);
    adjacency_->edges.keep_vertices(before, part.first_removed, mesh.edges);
    adjacency_->shared_edges = std::move(shared_edges_);
    adjacency_->shared_faces = std::move(shared_faces_);
}

}  // namespace octetra::distributed
