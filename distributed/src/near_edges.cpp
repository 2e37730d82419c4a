#include "near_edges.hpp"

#include <utility>

namespace octetra::distributed {
namespace {

/// Is this number of cells too large to number only theirs? The first time it may not be enough
/// yet; it nearly always is the second.
bool are_many(const DistributedMesh& mesh, std::size_t cell_count, bool is_first) {
    const double share = (is_first ? 1 : 1.5) * mesh.near_below;
    return static_cast<double>(cell_count) >= share * static_cast<double>(mesh.cells.size());
}

}  // namespace

NearEdges::NearEdges(const DistributedMesh& mesh, const ChosenCells& chosen) : mesh_(&mesh) {
    if (chosen.all || are_many(mesh, chosen.cells.size(), true)) {
        number_all();
        return;
    }
    is_near_.assign(mesh.points.size(), 0);
    for (const CellIndex c : chosen.cells) {
        for (const VertexIndex v : mesh.cells[c]) is_near_[v] = 1;
    }
    widen();
}

void NearEdges::number_all() {
    is_near_ = {};
    stars_ = EdgeStars(mesh_->points.size(), mesh_->cells);
}

void NearEdges::widen() {
    const bool is_first = rings_ == 0;
    const int ring_count = is_first ? 2 : rings_;
    for (int ring = 0; ring < ring_count; ++ring) add_ring();
    rings_ += ring_count;
    // Any of these may be selected on another process's word, and once is enough.
    for (const Interface& interface : mesh_->interfaces) {
        for (const auto& [a, b] : interface.edges) is_near_[a] = is_near_[b] = 1;
    }
    std::vector<CellIndex> cells = near_cells();
    if (are_many(*mesh_, cells.size(), is_first)) {
        number_all();
    } else {
        stars_ = EdgeStars(mesh_->points.size(), mesh_->cells, std::move(cells));
    }
}

/// Takes in the vertices next to those that are near.
void NearEdges::add_ring() {
    const auto before = is_near_;
    for (const CellVertices& cell : mesh_->cells) {
        const auto& [a, b, c, d] = cell;
        if ((before[a] | before[b] | before[c] | before[d]) == 0) continue;
        for (const VertexIndex v : cell) is_near_[v] = 1;
    }
}

/// Those at a near vertex, ascending.
std::vector<CellIndex> NearEdges::near_cells() const {
    std::vector<CellIndex> cells;
    for (CellIndex i{0}; i < mesh_->cells.end_index(); ++i) {
        const auto& [a, b, c, d] = mesh_->cells[i];
        if ((is_near_[a] | is_near_[b] | is_near_[c] | is_near_[d]) != 0) cells.push_back(i);
    }
    return cells;
}

}  // namespace octetra::distributed
