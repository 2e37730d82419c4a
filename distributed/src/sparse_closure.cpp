#include "sparse_closure.hpp"

#include <algorithm>
#include <utility>

#include "length_order.hpp"

namespace octetra::distributed {

SparseClosure::SparseClosure(const DistributedMesh& mesh, Adjacency& adjacency)
    : mesh_(&mesh), adjacency_(&adjacency), outboxes_(mesh.interfaces.size()) {}

void SparseClosure::select(CellIndex cell, EdgeMask edges) {
    const std::uint32_t note = note_of(cell);
    const auto missing = static_cast<EdgeMask>(edges & ~unsigned{notes_[note].selected});
    for (std::size_t e = 0; missing >> e != 0; ++e) {
        if ((missing >> e & 1U) == 0) continue;
        const auto [i, j] = cell_edges[e];
        const EdgeVertices edge{mesh_->cells[cell][i], mesh_->cells[cell][j]};
        mark(edge);
        tell_sharers(edge);
    }
}

// Who told has told all that share the edge.
void SparseClosure::select_from(std::size_t interface, std::uint32_t position) {
    const EdgeVertices& edge = mesh_->interfaces[interface].edges[position];
    if (!is_selected(edge)) mark(edge);
}

void SparseClosure::drain() {
    while (!queue_.empty()) {
        Note& note = notes_[queue_.back()];
        queue_.pop_back();
        note.queued = false;
        select(note.cell, table_->closure(note.order, note.selected));
    }
}

std::uint32_t SparseClosure::note_of(CellIndex cell) {
    std::uint32_t& number = adjacency_->cell_to_note[cell];
    if (number == CellIndex::none_value) {
        number = static_cast<std::uint32_t>(notes_.size());
        notes_.push_back({.cell = cell, .order = length_order(mesh_->points, mesh_->cells[cell])});
    }
    return number;
}

bool SparseClosure::is_selected(const EdgeVertices& edge) const {
    bool selected = false;
    adjacency_->cells.for_each_with(edge, mesh_->cells, [&](CellIndex cell, std::size_t e) {
        const std::uint32_t note = adjacency_->cell_to_note[cell];
        if (note != CellIndex::none_value && (unsigned{notes_[note].selected} >> e & 1U) != 0) {
            selected = true;
        }
    });
    return selected;
}

void SparseClosure::mark(const EdgeVertices& edge) {
    const auto [low, high] = std::minmax(edge[0], edge[1]);
    const EdgeIndex number = edges_.append({low, high});
    adjacency_->cells.for_each_with(edge, mesh_->cells, [&](CellIndex cell, std::size_t e) {
        const std::uint32_t n = note_of(cell);
        Note& note = notes_[n];
        note.edges[e] = number;
        note.selected = static_cast<EdgeMask>(note.selected | 1U << e);
        if (!note.queued) queue_.push_back(n);
        note.queued = true;
    });
}

void SparseClosure::tell_sharers(const EdgeVertices& edge) {
    adjacency_->shared_edges.for_each_with(edge, mesh_->interfaces, [&](const auto& found) {
        outboxes_[found.place.interface].push_back(found.place.position);
    });
}

std::vector<std::vector<std::uint32_t>> SparseClosure::take_outboxes() {
    return std::exchange(outboxes_, std::vector<std::vector<std::uint32_t>>(outboxes_.size()));
}

}  // namespace octetra::distributed
