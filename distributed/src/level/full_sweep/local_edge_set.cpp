#include "level/full_sweep/local_edge_set.hpp"

#include <algorithm>
#include <utility>

namespace octetra::distributed {
namespace {

constexpr int rings = 2;  ///< of vertices around those of marked cells; widen() adds as many

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
    // A larger fraction than at first, since this numbering is usually the last.
    number(1.5 * local_below_);
}

/// Adds rings and numbers the near cells if they are fewer than the fraction `most` of all cells;
/// otherwise numbers all cells.
void LocalEdgeSet::number(double most) {
    numbering_ = {};  // frees memory before the next numbering
    if (!is_near_.empty()) {
        for (int ring = 0; ring < rings; ++ring) add_ring();
        // Another process may mark any of these; to add them once is sufficient.
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

/// Returns the near cells, or nothing unless they are fewer than `most`.
std::optional<std::vector<CellIndex>> LocalEdgeSet::near_cells(double most) const {
    std::vector<CellIndex> cells;
    for (CellIndex c{0}; c < mesh_->cells.end_index(); ++c) {
        if (!is_near(mesh_->cells[c])) continue;
        cells.push_back(c);
        if (static_cast<double>(cells.size()) >= most) return std::nullopt;
    }
    return cells;
}

/// Adds the vertices of all cells that have a near vertex.
void LocalEdgeSet::add_ring() {
    const auto before = is_near_;
    for (const CellVertices& cell : mesh_->cells) {
        const auto& [a, b, c, d] = cell;
        if ((before[a] | before[b] | before[c] | before[d]) == 0) continue;
        for (const VertexIndex v : cell) is_near_[v] = 1;
    }
}

}  // namespace octetra::distributed
