#include "level/full_sweep/local_edge_set.hpp"

#include <algorithm>
#include <utility>

namespace octetra::distributed {
namespace {

constexpr int rings = 2;  ///< of vertices around those of marked cells, and as many more later

}  // namespace

LocalEdgeSet::LocalEdgeSet(const DistributedMesh& mesh, const MarkedCells& marked,
                           double local_below)
    : mesh_(&mesh), local_below_(local_below) {
    const auto cell_count = static_cast<double>(mesh.cells.size());
    if (!marked.all && static_cast<double>(marked.cells.size()) < local_below * cell_count) {
        is_near_.assign(mesh.points.size(), 0);
        for (const CellIndex c : marked.cells) {
            for (const VertexIndex v : mesh.cells[c]) is_near_[v] = 1;
        }
    }
    number(local_below);
}

void LocalEdgeSet::widen() {
    if (std::exchange(is_wider_, true)) is_near_ = {};
    // More than the first time, as it is most often enough now.
    number(1.5 * local_below_);
}

/// Adds rings and numbers; all, where the near cells are not less than this share of them.
void LocalEdgeSet::number(double most) {
    numbering_ = {};  // before the next ones need memory
    if (!is_near_.empty()) {
        for (int ring = 0; ring < rings; ++ring) add_ring();
        // Any of these may be marked on another process's word, and once is enough.
        for (const Interface& interface : mesh_->interfaces) {
            for (const auto& [a, b] : interface.edges) is_near_[a] = is_near_[b] = 1;
        }
        if (auto cells = near_cells(most * static_cast<double>(mesh_->cells.size()))) {
            numbering_ = EdgeNumbering(mesh_->points.size(), mesh_->cells, *std::move(cells));
            return;
        }
        is_near_ = {};
    }
    numbering_ = EdgeNumbering(mesh_->points.size(), mesh_->cells);
}

/// Nothing unless they are less than `most`.
std::optional<std::vector<CellIndex>> LocalEdgeSet::near_cells(double most) const {
    std::vector<CellIndex> cells;
    for (CellIndex c{0}; c < mesh_->cells.end_index(); ++c) {
        if (!is_near(mesh_->cells[c])) continue;
        cells.push_back(c);
        if (static_cast<double>(cells.size()) >= most) return std::nullopt;
    }
    return cells;
}

/// Takes in the vertices next to those that are near.
void LocalEdgeSet::add_ring() {
    const auto before = is_near_;
    for (const CellVertices& cell : mesh_->cells) {
        const auto& [a, b, c, d] = cell;
        if ((before[a] | before[b] | before[c] | before[d]) == 0) continue;
        for (const VertexIndex v : cell) is_near_[v] = 1;
    }
}

}  // namespace octetra::distributed
